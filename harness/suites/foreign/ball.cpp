// A renderer of somebody else: it path-traces balls on a floor under two lights, and reads its own file format.
//   ball SCENE OUTPUT.pfm WIDTH HEIGHT SPP SEED [FAULT]
// A line of SCENE is "x y z radius  red green blue  glow". FAULT plants a mistake, as faults.txt lists them.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

struct V {
  double x = 0, y = 0, z = 0;
  V operator+(V o) const { return {x + o.x, y + o.y, z + o.z}; }
  V operator-(V o) const { return {x - o.x, y - o.y, z - o.z}; }
  V operator*(V o) const { return {x * o.x, y * o.y, z * o.z}; }
  V operator*(double s) const { return {x * s, y * s, z * s}; }
};
static double dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static V unit(V a) { return a * (1 / std::sqrt(dot(a, a))); }

struct Ball {
  V centre;
  double radius;
  V colour;
  double glow;
};
static std::vector<Ball> balls;

static const Ball* hit(V o, V d, double& t) {
  const Ball* nearest = nullptr;
  t = std::numeric_limits<double>::infinity();
  for (const Ball& ball : balls) {
    const V to = ball.centre - o;
    const double b = dot(to, d), h = b * b - dot(to, to) + ball.radius * ball.radius;
    if (h < 0) continue;
    const double root = std::sqrt(h), at = b - root > 1e-6 ? b - root : b + root;
    if (at > 1e-6 && at < t) t = at, nearest = &ball;
  }
  return nearest;
}

struct Random {
  std::mt19937_64 bits;
  double operator()() { return double(bits() >> 11) * 0x1p-53; }
  V direction() {  // uniform on the sphere
    const double z = 2 * (*this)() - 1, phi = 6.283185307179586 * (*this)(), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
};

static V light_along(V o, V d, Random& random) {
  V light, weight{1, 1, 1};
  for (int bounce = 0; bounce < 4; ++bounce) {
    double t;
    const Ball* ball = hit(o, d, t);
    if (ball == nullptr) return light + weight * V{0.10, 0.12, 0.16};  // the sky
    light = light + weight * ball->colour * ball->glow;
    if (ball->glow > 0) return light;
    o = o + d * t;
    const V n = unit(o - ball->centre);
    d = unit(n + random.direction() * 0.999999);  // in proportion to the cosine
    weight = weight * ball->colour;
  }
  return light;
}

int main(int argc, char** argv) {
  if (argc < 7) return 2;
  const std::string fault = argc > 7 ? argv[7] : "none";
  int width = std::atoi(argv[3]), height = std::atoi(argv[4]);
  const int spp = std::atoi(argv[5]);
  std::ifstream scene(argv[1]);
  for (Ball b;
       scene >> b.centre.x >> b.centre.y >> b.centre.z >> b.radius >> b.colour.x >> b.colour.y >> b.colour.z >> b.glow;)
    if (fault != "light" || b.glow < 2) balls.push_back(b);
  if (balls.empty()) return std::fprintf(stderr, "%s: no balls\n", argv[1]), 1;
  if (fault == "crash") std::abort();
  if (fault == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
  if (fault == "no-image") return 0;
  if (fault == "size") width /= 2;
  Random random{std::mt19937_64(fault == "stuck-seed" ? 1 : std::strtoull(argv[6], nullptr, 10))};
  std::vector<float> image(3 * std::size_t(width) * std::size_t(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      V sum;
      for (int i = 0; i < spp; ++i) {
        const double px = x + random() + (fault == "shifted" ? -1 : 0), py = y + random();
        const V d = unit({(2 * px - width) / height, 1 - 2 * py / height, 2});
        sum = sum + light_along({0, 0.6, -4}, d, random);
      }
      V v = sum * (1.0 / spp);
      if (fault == "dim") v = v * 0.98;
      if (fault == "gamma") v = {std::pow(v.x, 1 / 2.2), std::pow(v.y, 1 / 2.2), std::pow(v.z, 1 / 2.2)};
      if (fault == "channels") std::swap(v.x, v.z);
      if (fault == "nan" && x == 9 && y == 7) v.y = std::nan("");
      const int column = fault == "mirrored" ? width - 1 - x : x;
      float* pixel = &image[3 * (std::size_t(height - 1 - y) * std::size_t(width) + std::size_t(column))];  // upwards
      pixel[0] = float(v.x), pixel[1] = float(v.y), pixel[2] = float(v.z);
    }
  std::ofstream out(argv[2], std::ios::binary);
  out << "PF\n" << width << " " << height << "\n-1.0\n";
  out.write(reinterpret_cast<const char*>(image.data()), std::streamsize(4 * image.size()));
  return out ? 0 : 1;
}
