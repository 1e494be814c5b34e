#include "harness/statistics/batch_means.h"

#include <cmath>
#include <cstring>
#include <string>

#include "harness/statistics/radiance_range.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr char magic[] = "photonproof batches 2\n";
constexpr std::size_t magic_bytes = sizeof magic - 1;

struct Header {
  std::int32_t width, height, samples_per_batch, batches;
  double squared_biases;
};

std::uint64_t checksum_of(const char* bytes, std::size_t count) {
  Checksum checksum;
  checksum.add(bytes, count);
  return checksum.value();
}

void append(std::string& out, const void* bytes, std::size_t count) {
  out.append(static_cast<const char*>(bytes), count);
}

}  // namespace

BatchMeans::BatchMeans(int width, int height, int samples_per_batch)
    : width_(width),
      height_(height),
      samples_per_batch_(samples_per_batch),
      mean_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      squares_(mean_.size()) {}

void BatchMeans::add(const Image& batch, const std::string& where, double squared_bias) {
  if (batch.width != width_ || batch.height != height_) throw InputError(where, "is of another size than its batch");
  for (const float v : batch.rgb)
    if (!std::isfinite(v)) throw InputError(where, "has a value that is not finite: no reference can be made of it");
  if (const std::string why = why_variance_is_lost(batch); !why.empty()) throw InputError(where, why);
  ++batches_;
  squared_biases_ += squared_bias;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    const double before = batch.rgb[i] - mean_[i];
    mean_[i] += before / batches_;
    squares_[i] += before * (batch.rgb[i] - mean_[i]);
  }
}

double BatchMeans::relative_bias() const { return batches_ > 0 ? std::sqrt(squared_biases_ / batches_) : 0; }

Rendering BatchMeans::rendering() const {
  Rendering rendering{Image(width_, height_), Image(width_, height_), {}};
  const double divisor = double(batches_) * (batches_ - 1);
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    rendering.mean.rgb[i] = static_cast<float>(mean_[i]);
    rendering.variance->rgb[i] = static_cast<float>(squares_[i] / divisor);
  }
  return rendering;
}

void BatchMeans::save(const std::filesystem::path& file) const {
  const Header header{width_, height_, samples_per_batch_, batches_, squared_biases_};
  std::string bytes(magic, magic_bytes);
  append(bytes, &header, sizeof header);
  for (const std::vector<double>* sums : {&mean_, &squares_})
    append(bytes, sums->data(), sums->size() * sizeof(double));
  const std::uint64_t checksum = checksum_of(bytes.data(), bytes.size());
  append(bytes, &checksum, sizeof checksum);
  write_file_atomically(file, bytes);
}

BatchMeans BatchMeans::load(const std::filesystem::path& file) {
  const std::string bytes = read_file(file, std::size_t{1} << 36);
  const auto damaged = [&] { throw InputError(file.string(), "is damaged: delete it to begin this reference anew"); };
  Header header;
  std::uint64_t checksum = 0;
  constexpr std::size_t least = magic_bytes + sizeof header + sizeof checksum;
  if (bytes.size() < least || std::memcmp(bytes.data(), magic, magic_bytes) != 0) damaged();
  std::memcpy(&checksum, bytes.data() + bytes.size() - sizeof checksum, sizeof checksum);
  if (checksum != checksum_of(bytes.data(), bytes.size() - sizeof checksum)) damaged();
  std::memcpy(&header, bytes.data() + magic_bytes, sizeof header);
  BatchMeans means(header.width, header.height, header.samples_per_batch);
  means.batches_ = header.batches;
  means.squared_biases_ = header.squared_biases;
  const std::size_t sum_bytes = means.mean_.size() * sizeof(double);
  if (bytes.size() != least + 2 * sum_bytes) damaged();
  std::memcpy(means.mean_.data(), bytes.data() + magic_bytes + sizeof header, sum_bytes);
  std::memcpy(means.squares_.data(), bytes.data() + magic_bytes + sizeof header + sum_bytes, sum_bytes);
  return means;
}

}  // namespace photonproof::inline harness_statistics
