namespace {
double twice(double x) { return 2 * x; }
}  // namespace

double b() { return twice(1); }
