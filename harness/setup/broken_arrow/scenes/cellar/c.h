// What a lower room may not.
#include "scenes/attic/a.h"
namespace photonproof {
