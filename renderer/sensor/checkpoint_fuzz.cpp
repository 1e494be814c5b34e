// Fuzzes the reading of checkpoints. Built with libFuzzer (preset fuzz), and run over checkpoint_corpus/ by
// checkpoint_fuzz_test.cpp. An input that begins with '+' is the part between a checkpoint's first line and its
// checksum, which is then appended: otherwise no input would get that far. Any other input is the whole file.
#include "renderer/sensor/checkpoint_fuzz.h"

#include <cmath>
#include <cstring>

#include "renderer/core/checkpoint.h"
#include "renderer/sensor/film.h"
#include "scenes/base/test_fuzz.h"

namespace photonproof::inline renderer_sensor {
namespace {

constexpr std::string_view first_line = "photonproof checkpoint 1\n";

std::string file_of(std::string_view bytes) {
  if (!bytes.starts_with('+')) return std::string(bytes);
  std::string whole = std::string(first_line) + std::string(bytes.substr(1));
  Checksum checksum;
  checksum.add(whole.data(), whole.size());
  const std::uint64_t sum = checksum.value();
  whole.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return whole;
}

/// Data that renders keep: a film, tables, numbers and texts.
struct State {
  Film film{{0, 0, 3, 2}};
  std::vector<float> table = std::vector<float>(4);
  double number = 0;
  std::string text;
};

std::string state_text(const State& state) {
  std::string text;
  StateWriter out(text);
  state.film.save(out);
  out.vector(state.table);
  out.value(state.number);
  out.text(state.text);
  return text;
}

}  // namespace

std::string check_checkpoint(std::string_view bytes) {
  static const FuzzFolder folder;
  const std::filesystem::path file = folder.put("render.checkpoint", file_of(bytes));
  State state;
  std::uint64_t read = 0;
  try {
    read_checkpoint(file, {{"program", "fuzz"}, {"seed", "1"}}, [&](StateReader& in) {
      read = in.bytes_left();
      state.film.restore(in);
      in.vector(state.table);
      state.number = in.value<double>();
      state.text = in.text();
    });
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  // Every bit of it is in the state, which gives it back.
  const std::string again = state_text(state);
  if (again.size() != read) return "a state of " + std::to_string(read) + " bytes is written as another";
  const std::string whole = file_of(bytes);
  const std::string_view stored = std::string_view(whole).substr(whole.size() - sizeof(std::uint64_t) - read, read);
  return again == stored ? "" : "writing what was read gives other bytes";
}

}  // namespace photonproof::inline renderer_sensor

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_checkpoint, data, size);
}
#endif
