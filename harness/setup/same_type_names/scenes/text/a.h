// What type_names.py must refuse.
namespace photonproof {
struct Twice {};
}  // namespace photonproof
