#include "harness/diagnosis/diagnosis.h"
