#include "image.h"

#include <cstdio>
#include <stdexcept>

unsigned char to_byte(double value) {
  return static_cast<unsigned char>(std::min(std::max(value, 0.0), 1.0) * 255 + 0.5);
}

static void put(std::string* bytes, unsigned value, int count) {
  for (int i = 0; i < count; ++i) bytes->push_back(static_cast<char>(value >> (8 * i) & 255));
}

static std::string ppm(int width, int height, const std::vector<Vec3>& picture) {
  std::string bytes = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (Vec3 p : picture)
    for (double value : {p.x, p.y, p.z}) put(&bytes, to_byte(value), 1);
  return bytes;
}

// 24 bits a pixel, blue first, the bottom row first, rows padded to a multiple of four bytes.
static std::string bmp(int width, int height, const std::vector<Vec3>& picture) {
  unsigned row = (3 * width + 3) / 4 * 4, size = row * height;
  std::string bytes = "BM";
  for (unsigned value : {54 + size, 0u, 54u, 40u, unsigned(width), unsigned(height)}) put(&bytes, value, 4);
  put(&bytes, 1, 2);
  put(&bytes, 24, 2);
  for (unsigned value : {0u, size, 2835u, 2835u, 0u, 0u}) put(&bytes, value, 4);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      Vec3 p = picture[y * width + x];
      for (double value : {p.z, p.y, p.x}) put(&bytes, to_byte(value), 1);
    }
    put(&bytes, 0, row - 3 * width);
  }
  return bytes;
}

void write_image(const std::string& name, int width, int height, const std::vector<Vec3>& picture) {
  bool is_ppm = name.size() > 4 && name.substr(name.size() - 4) == ".ppm";
  std::string bytes = is_ppm ? ppm(width, height, picture) : bmp(width, height, picture);
  FILE* file = std::fopen(name.c_str(), "wb");
  if (!file) throw std::runtime_error("cannot write " + name);
  bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (std::fclose(file) != 0 || !whole) throw std::runtime_error("cannot write all of " + name);
}
