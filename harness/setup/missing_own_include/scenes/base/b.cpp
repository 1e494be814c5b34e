namespace photonproof {

int four_times(int x) { return twice(twice(x)); }

}  // namespace photonproof
