// An include that an upper room may have.
#include "scenes/cellar/c.h"
