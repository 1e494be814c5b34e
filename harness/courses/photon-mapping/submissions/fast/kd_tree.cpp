#include "kd_tree.h"

#include <algorithm>
#include <thread>

// The middle of a range is its node; points below and above it are before and after it.
static void arrange(Photon* first, Photon* last, int threads) {
  if (last - first < 2) {
    if (last > first) first->axis = 0;
    return;
  }
  float low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) low[axis] = 1e30f, high[axis] = -1e30f;
  for (Photon* p = first; p != last; ++p)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p->position[axis]);
      high[axis] = std::max(high[axis], p->position[axis]);
    }
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  Photon* middle = first + (last - first) / 2;
  std::nth_element(first, middle, last,
                   [axis](const Photon& a, const Photon& b) { return a.position[axis] < b.position[axis]; });
  middle->axis = axis;
  if (threads > 1) {
    std::thread other([=] { arrange(first, middle, threads / 2); });
    arrange(middle + 1, last, threads / 2);
    other.join();
  } else {
    arrange(first, middle, 1);
    arrange(middle + 1, last, 1);
  }
}

void KdTree::build(std::vector<Photon> photons) {
  photons_ = std::move(photons);
  int threads = photons_.size() > 4000 ? int(std::thread::hardware_concurrency()) : 1;
  arrange(photons_.data(), photons_.data() + photons_.size(), threads);
}

namespace {

struct Near {
  float d2;
  const Photon* photon;
  bool operator<(const Near& other) const { return d2 < other.d2; }
};

struct Search {
  float position[3], normal[3];
  float flat;  // greatest distance from the tangent plane
  float d2;    // photons at this distance are not needed
  int wanted;
  int found = 0;
  Near* near;  // a heap with the farthest on top, once it is full

  void visit(const Photon* first, const Photon* last) {
    while (first < last) {
      const Photon* p = first + (last - first) / 2;
      offer(p);
      float side = position[p->axis] - p->position[p->axis];
      if (side < 0) {
        visit(first, p);
        if (side * side >= d2) return;
        first = p + 1;
      } else {
        visit(p + 1, last);
        if (side * side >= d2) return;
        last = p;
      }
    }
  }

  void offer(const Photon* p) {
    float x = p->position[0] - position[0], y = p->position[1] - position[1], z = p->position[2] - position[2];
    float away = x * x + y * y + z * z;
    if (away >= d2) return;
    if (p->normal[0] * normal[0] + p->normal[1] * normal[1] + p->normal[2] * normal[2] <= 0.9f) return;
    if (std::fabs(x * normal[0] + y * normal[1] + z * normal[2]) >= flat) return;
    if (found < wanted) {
      near[found++] = {away, p};
      if (found < wanted) return;
      std::make_heap(near, near + found);
    } else {
      std::pop_heap(near, near + found);
      near[found - 1] = {away, p};
      std::push_heap(near, near + found);
    }
    d2 = near[0].d2;
  }
};

Search start(Vec3 p, Vec3 n, int wanted, double radius, Near* near) {
  Search search;
  search.position[0] = float(p.x), search.position[1] = float(p.y), search.position[2] = float(p.z);
  search.normal[0] = float(n.x), search.normal[1] = float(n.y), search.normal[2] = float(n.z);
  search.flat = float(0.1 * radius);
  search.d2 = float(radius * radius);
  search.wanted = wanted;
  search.near = near;
  return search;
}

}  // namespace

Vec3 KdTree::irradiance(Vec3 position, Vec3 normal, int count, double radius) const {
  static thread_local std::vector<Near> near;
  if (int(near.size()) < count) near.resize(count);
  Search search = start(position, normal, count, radius, near.data());
  search.visit(photons_.data(), photons_.data() + photons_.size());
  // The farthest photon only limits the radius of the others.
  Vec3 sum;
  for (int i = search.found == count ? 1 : 0; i < search.found; ++i) {
    const float* power = near[i].photon->power;
    sum += Vec3{power[0], power[1], power[2]};
  }
  return sum / (PI * search.d2);
}

const Photon* KdTree::nearest(Vec3 position, Vec3 normal, double radius) const {
  Near near[2] = {};  // of which the search uses one; the compiler fears for the next
  Search search = start(position, normal, 1, radius, near);
  search.visit(photons_.data(), photons_.data() + photons_.size());
  return near[0].photon;
}
