#pragma once
#include <vector>
int find_two(const std::vector<int>& from);
