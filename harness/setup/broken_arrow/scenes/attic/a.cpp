// What an upper room may do.
#include "scenes/cellar/c.h"
