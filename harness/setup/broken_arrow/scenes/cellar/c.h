// An include that a lower room must not have.
#include "scenes/attic/a.h"
namespace photonproof {
