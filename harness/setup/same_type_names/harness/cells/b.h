namespace photonproof {
namespace {
struct Once {};
}  // namespace
class Twice {};
}  // namespace photonproof
