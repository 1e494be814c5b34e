#include "displaced_surface.h"

#include "config.h"
#include "noise.h"

// The code below uses the water's own coordinates: x and y from -1 to 1 along the half-edges, z along `up`. A ray's t
// is the same in them as in the world.

double DisplacedSurface::height(int column, int row) const {
  double x = 2.0 * column / water_.columns - 1, y = 2.0 * row / water_.rows - 1;
  return noise(x * water_.frequency_a, y * water_.frequency_b, water_.seed);
}

Vec3 DisplacedSurface::corner(int column, int row) const {
  return {2.0 * column / water_.columns - 1, 2.0 * row / water_.rows - 1, height(column, row)};
}

// The normal at a corner of the grid, from its neighbours' heights; not of length 1.
Vec3 DisplacedSurface::slope_normal(int column, int row) const {
  double dx = (height(column + 1, row) - height(column - 1, row)) * water_.columns / 4;
  double dy = (height(column, row + 1) - height(column, row - 1)) * water_.rows / 4;
  return {-dx, -dy, 1};
}

// Moeller and Trumbore 1997. Where in the triangle: (1 - u - v) p + u q + v r.
static bool intersect_triangle(const Ray& ray, Vec3 p, Vec3 q, Vec3 r, double* t, double* u, double* v) {
  Vec3 e = q - p, f = r - p, h = cross(ray.direction, f);
  double determinant = dot(e, h);
  if (determinant == 0) return false;
  Vec3 from = ray.origin - p;
  *u = dot(from, h) / determinant;
  *v = dot(ray.direction, cross(from, e)) / determinant;
  *t = dot(f, cross(from, e)) / determinant;
  return *u >= 0 && *v >= 0 && *u + *v <= 1 && *t >= EPSILON;
}

bool DisplacedSurface::intersect_cell(const Ray& local, int column, int row, double* t, Vec3* normal) const {
  bool any = false;
  for (int upper = 0; upper < 2; ++upper) {
    // Both triangles have the diagonal from (column, row) to (column + 1, row + 1).
    int second_row = row + upper, third_column = column + 1 - upper;
    double s, u, v;
    bool met = intersect_triangle(local, corner(column, row), corner(column + 1, second_row),
                                  corner(third_column, row + 1), &s, &u, &v);
    if (!met || (any && s >= *t)) continue;
    any = true;
    *t = s;
    *normal = slope_normal(column, row) * (1 - u - v) + slope_normal(column + 1, second_row) * u +
              slope_normal(third_column, row + 1) * v;
  }
  return any;
}

// Shortens [near, far] to where origin + t * direction is between -limit and limit.
static void clip(double origin, double direction, double limit, double* near, double* far) {
  if (direction == 0) {
    if (std::fabs(origin) > limit) *far = -1;
    return;
  }
  double t0 = (-limit - origin) / direction, t1 = (limit - origin) / direction;
  *near = std::max(*near, std::min(t0, t1));
  *far = std::min(*far, std::max(t0, t1));
}

bool DisplacedSurface::intersect(const Ray& ray, Intersection* hit) const {
  const Water& w = water_;
  auto to_local = [&](Vec3 p) {
    Vec3 n = cross(w.a, w.b);
    return Vec3{dot(cross(p, w.b), n) / dot(n, n), dot(cross(w.a, p), n) / dot(n, n), dot(p, w.up) / dot(w.up, w.up)};
  };
  Ray local{to_local(ray.origin - w.center), to_local(ray.direction)};
  double near = 0, far = 1e30;
  clip(local.origin.x, local.direction.x, 1, &near, &far);
  clip(local.origin.y, local.direction.y, 1, &near, &far);
  clip(local.origin.z, local.direction.z, 1.2, &near, &far);
  if (near > far) return false;

  // Walks from cell to cell along the ray.
  Vec3 entry = local.at(near);
  int column = std::min(std::max(int((entry.x + 1) / 2 * w.columns), 0), w.columns - 1);
  int row = std::min(std::max(int((entry.y + 1) / 2 * w.rows), 0), w.rows - 1);
  int step_column = local.direction.x > 0 ? 1 : -1, step_row = local.direction.y > 0 ? 1 : -1;
  while (column >= 0 && column < w.columns && row >= 0 && row < w.rows) {
    double t;
    Vec3 n;
    if (intersect_cell(local, column, row, &t, &n)) {
      // The inverse transposed transform takes gradients to the world: cross products of the other two axes.
      Vec3 world = cross(w.b, w.up) * n.x + cross(w.up, w.a) * n.y + cross(w.a, w.b) * n.z;
      if (dot(w.up, cross(w.a, w.b)) < 0) world = -world;
      set_hit(ray, t, normalized(world), hit);
      return true;
    }
    double border_x = 2.0 * (column + (step_column > 0)) / w.columns - 1;
    double border_y = 2.0 * (row + (step_row > 0)) / w.rows - 1;
    double tx = local.direction.x == 0 ? 1e30 : (border_x - local.origin.x) / local.direction.x;
    double ty = local.direction.y == 0 ? 1e30 : (border_y - local.origin.y) / local.direction.y;
    if (std::min(tx, ty) > far) return false;
    if (tx < ty) {
      column += step_column;
    } else {
      row += step_row;
    }
  }
  return false;
}
