#include "packed_scene.h"

#include "config.h"
#include "noise.h"

void PackedScene::add_rectangle(Vec3 center, Vec3 a, Vec3 b, const Material& material) {
  Vec3 n = cross(a, b);
  Rectangle r;
  r.normal = normalized(n), r.u = cross(b, n) / dot(n, n), r.v = cross(n, a) / dot(n, n);
  r.dn = dot(r.normal, center), r.du = dot(r.u, center), r.dv = dot(r.v, center);
  r.center = center, r.a = a, r.b = b;
  r.material = int(materials_.size());
  rectangles_.push_back(r);
  materials_.push_back(material);
}

void PackedScene::add_ball(Vec3 center, double radius, const Material& material) {
  balls_.push_back({center, radius * radius, int(materials_.size())});
  materials_.push_back(material);
}

void PackedScene::add_water(const Water& w, const Material& material) {
  Grid g;
  Vec3 n = cross(w.a, w.b);
  g.center = w.center;
  g.to_x = cross(w.b, n) / dot(n, n), g.to_y = cross(n, w.a) / dot(n, n), g.to_z = w.up / dot(w.up, w.up);
  double side = dot(w.up, n) < 0 ? -1 : 1;
  g.normal_x = cross(w.b, w.up) * side, g.normal_y = cross(w.up, w.a) * side, g.normal_z = n * side;
  g.columns = w.columns, g.rows = w.rows;
  int wide = w.columns + 3;  // a corner more on each side, for the slopes at the border
  std::vector<double> all(wide * (w.rows + 3));
  for (int row = 0; row < w.rows + 3; ++row)
    for (int column = 0; column < wide; ++column)
      all[row * wide + column] = noise((2.0 * (column - 1) / w.columns - 1) * w.frequency_a,
                                       (2.0 * (row - 1) / w.rows - 1) * w.frequency_b, w.seed);
  g.low = 1e30, g.high = -1e30;
  for (int row = 1; row < w.rows + 2; ++row)
    for (int column = 1; column < w.columns + 2; ++column) {
      const double* h = &all[row * wide + column];
      g.heights.push_back(*h);
      g.normals.push_back({(h[-1] - h[1]) * w.columns / 4, (h[-wide] - h[wide]) * w.rows / 4, 1});
      g.low = std::min(g.low, *h), g.high = std::max(g.high, *h);
    }
  g.material = int(materials_.size());
  grids_.push_back(g);
  materials_.push_back(material);
}

static void clip(double origin, double direction, double low, double high, double* near, double* far) {
  double t0 = (low - origin) / direction, t1 = (high - origin) / direction;
  *near = std::max(*near, std::min(t0, t1));
  *far = std::min(*far, std::max(t0, t1));
}

static bool meet_triangle(const Ray& ray, Vec3 p, Vec3 q, Vec3 r, double* t, double* u, double* v) {
  Vec3 e = q - p, f = r - p, h = cross(ray.direction, f);
  double factor = 1 / dot(e, h);
  Vec3 from = ray.origin - p, k = cross(from, e);
  *u = dot(from, h) * factor, *v = dot(ray.direction, k) * factor, *t = dot(f, k) * factor;
  return *u >= 0 && *v >= 0 && *u + *v <= 1 && *t >= EPSILON;
}

bool PackedScene::meet(const Grid& g, const Ray& ray, double most, double* t, Vec3* normal) const {
  Vec3 o = ray.origin - g.center, d = ray.direction;
  Ray local{{dot(o, g.to_x), dot(o, g.to_y), dot(o, g.to_z)}, {dot(d, g.to_x), dot(d, g.to_y), dot(d, g.to_z)}};
  double near = 0, far = most;
  clip(local.origin.z, local.direction.z, g.low - 1e-9, g.high + 1e-9, &near, &far);
  clip(local.origin.x, local.direction.x, -1, 1, &near, &far);
  clip(local.origin.y, local.direction.y, -1, 1, &near, &far);
  if (!(near <= far)) return false;
  Vec3 entry = local.at(near);
  int column = std::min(std::max(int((entry.x + 1) / 2 * g.columns), 0), g.columns - 1);
  int row = std::min(std::max(int((entry.y + 1) / 2 * g.rows), 0), g.rows - 1);
  int step_column = local.direction.x > 0 ? 1 : -1, step_row = local.direction.y > 0 ? 1 : -1;
  double step_tx = std::fabs(2.0 / g.columns / local.direction.x),
         step_ty = std::fabs(2.0 / g.rows / local.direction.y);
  double tx = (2.0 * (column + (step_column > 0)) / g.columns - 1 - local.origin.x) / local.direction.x;
  double ty = (2.0 * (row + (step_row > 0)) / g.rows - 1 - local.origin.y) / local.direction.y;
  if (local.direction.x == 0) tx = 1e30;
  if (local.direction.y == 0) ty = 1e30;
  while (true) {
    double leave = std::min(std::min(tx, ty), far);
    const double* h = &g.heights[row * (g.columns + 1) + column];
    double h00 = h[0], h10 = h[1], h01 = h[g.columns + 1], h11 = h[g.columns + 2];
    double z0 = local.origin.z + near * local.direction.z, z1 = local.origin.z + leave * local.direction.z;
    if (std::max(z0, z1) >= std::min(std::min(h00, h10), std::min(h01, h11)) - 1e-7 &&
        std::min(z0, z1) <= std::max(std::max(h00, h10), std::max(h01, h11)) + 1e-7) {
      double x0 = 2.0 * column / g.columns - 1, x1 = 2.0 * (column + 1) / g.columns - 1;
      double y0 = 2.0 * row / g.rows - 1, y1 = 2.0 * (row + 1) / g.rows - 1;
      const Vec3* n = &g.normals[row * (g.columns + 1) + column];
      double best = most, s, u, v;
      if (meet_triangle(local, {x0, y0, h00}, {x1, y0, h10}, {x1, y1, h11}, &s, &u, &v) && s < best) {
        best = s;
        *normal = n[0] * (1 - u - v) + n[1] * u + n[g.columns + 2] * v;
      }
      if (meet_triangle(local, {x0, y0, h00}, {x1, y1, h11}, {x0, y1, h01}, &s, &u, &v) && s < best) {
        best = s;
        *normal = n[0] * (1 - u - v) + n[g.columns + 2] * u + n[g.columns + 1] * v;
      }
      if (best < most) {
        *t = best;
        return true;
      }
    }
    if (leave >= far) return false;
    near = leave;
    if (tx < ty) {
      column += step_column, tx += step_tx;
      if (column < 0 || column >= g.columns) return false;
    } else {
      row += step_row, ty += step_ty;
      if (row < 0 || row >= g.rows) return false;
    }
  }
}

// The nearest hit of a ball, or 1e30.
static double meet_ball(const Ray& ray, Vec3 center, double r2) {
  Vec3 from = ray.origin - center;
  double half = dot(from, ray.direction), inside = half * half - dot(from, from) + r2;
  if (inside < 0) return 1e30;
  double root = std::sqrt(inside), t = -half - root;
  if (t < EPSILON) t = -half + root;
  return t < EPSILON ? 1e30 : t;
}

bool PackedScene::first_hit(const Ray& ray, Hit* hit) const {
  double most = 1e30;
  int rectangle = -1, ball = -1;
  for (int i = 0; i < int(rectangles_.size()); ++i) {
    const Rectangle& r = rectangles_[i];
    double t = (r.dn - dot(ray.origin, r.normal)) / dot(ray.direction, r.normal);
    if (!(t >= EPSILON && t < most)) continue;
    Vec3 p = ray.at(t);
    double u = dot(p, r.u) - r.du, v = dot(p, r.v) - r.dv;
    if (std::fabs(u) > 1 || std::fabs(v) > 1) continue;
    most = t, rectangle = i, hit->u = u, hit->v = v;
  }
  for (int i = 0; i < int(balls_.size()); ++i) {
    double t = meet_ball(ray, balls_[i].center, balls_[i].r2);
    if (t < most) most = t, ball = i;
  }
  int material = ball >= 0 ? balls_[ball].material : rectangle >= 0 ? rectangles_[rectangle].material : -1;
  Vec3 normal;
  bool met_water = false;
  for (const Grid& grid : grids_) {
    Vec3 n;
    if (!meet(grid, ray, most, &most, &n)) continue;
    normal = normalized(grid.normal_x * n.x + grid.normal_y * n.y + grid.normal_z * n.z);
    material = grid.material;
    met_water = true;
  }
  if (material < 0) return false;
  hit->t = most;
  hit->position = ray.at(most);
  hit->rectangle = met_water || ball >= 0 ? -1 : rectangle;
  if (!met_water) normal = ball >= 0 ? normalized(hit->position - balls_[ball].center) : rectangles_[rectangle].normal;
  hit->normal = normal;
  hit->front = dot(ray.direction, normal) < 0;
  hit->material = &materials_[material];
  return true;
}

bool PackedScene::blocked(const Ray& ray, double most) const {
  for (const Ball& ball : balls_)
    if (meet_ball(ray, ball.center, ball.r2) < most) return true;
  for (const Rectangle& r : rectangles_) {
    double t = (r.dn - dot(ray.origin, r.normal)) / dot(ray.direction, r.normal);
    if (!(t >= EPSILON && t < most)) continue;
    Vec3 p = ray.at(t);
    if (std::fabs(dot(p, r.u) - r.du) <= 1 && std::fabs(dot(p, r.v) - r.dv) <= 1) return true;
  }
  for (const Grid& grid : grids_) {
    double t;
    Vec3 n;
    if (meet(grid, ray, most, &t, &n)) return true;
  }
  return false;
}
