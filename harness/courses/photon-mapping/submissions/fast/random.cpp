#include "random.h"

static uint64_t seed_of_all = 1;

void seed_random(unsigned long long seed) { seed_of_all = stirred(seed + 0x9e3779b97f4a7c15ull); }

uint64_t random_seed() { return seed_of_all; }
