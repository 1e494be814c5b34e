// What local_names.py must refuse.
namespace {
int twice(int x) { return 2 * x; }
}  // namespace

int a() { return twice(1); }
