#include "photon_map.h"

#include <cstddef>

static double coordinate(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

void PhotonMap::store(const Photon& photon) {
  std::shared_ptr<Node> node = std::make_shared<Node>();
  node->photon = photon;
  ++size_;
  if (!root_) {
    root_ = node;
    return;
  }
  std::shared_ptr<Node> parent = root_;
  for (int axis = 0;; axis = (axis + 1) % 3) {
    bool below = coordinate(photon.position, axis) < coordinate(parent->photon.position, axis);
    std::shared_ptr<Node>& child = below ? parent->lower : parent->upper;
    if (!child) {
      child = node;
      return;
    }
    parent = child;
  }
}

void PhotonMap::look_up(std::shared_ptr<Node> node, int axis, Vec3 position, Vec3 normal, int count, double radius,
                        std::vector<Photon>* found) const {
  if (!node) return;
  // Nothing farther than the farthest of enough photons is wanted.
  double reach = int(found->size()) < count ? radius : length(found->back().position - position);
  Vec3 way = node->photon.position - position;
  if (length(way) < reach && dot(node->photon.normal, normal) > 0.9 && std::fabs(dot(way, normal)) < 0.1 * radius) {
    std::size_t place = 0;
    while (place < found->size() && length((*found)[place].position - position) < length(way)) ++place;
    found->insert(found->begin() + int(place), node->photon);
    if (int(found->size()) > count) found->pop_back();
  }
  double side = coordinate(position, axis) - coordinate(node->photon.position, axis);
  int next = (axis + 1) % 3;
  look_up(side < 0 ? node->lower : node->upper, next, position, normal, count, radius, found);
  if (std::fabs(side) < radius)
    look_up(side < 0 ? node->upper : node->lower, next, position, normal, count, radius, found);
}

std::vector<Photon> PhotonMap::nearest(Vec3 position, Vec3 normal, int count, double radius) const {
  std::vector<Photon> found;
  look_up(root_, 0, position, normal, count, radius, &found);
  return found;
}

Vec3 PhotonMap::irradiance(Vec3 position, Vec3 normal, int count, double radius) const {
  std::vector<Photon> photons = nearest(position, normal, count, radius);
  Vec3 sum;
  if (int(photons.size()) == count) {
    // Enough: the last one only says how far the others reach.
    radius = length(photons.back().position - position);
    photons.pop_back();
  }
  for (Photon photon : photons) sum += photon.power;
  return sum / (PI * radius * radius);
}
