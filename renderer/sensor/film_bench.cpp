// The film at 512 x 512: adding one estimate to every pixel, and developing two into mean and variance.

#include <benchmark/benchmark.h>

#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_sensor {
namespace {

constexpr int side = 512;

void add_to_every_pixel(Film& film) {
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) film.add(x, y, RgbD(x, y, x + y), 4);
}

void film_add(benchmark::State& state) {
  Film film(side, side);
  for (auto _ : state) {
    add_to_every_pixel(film);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * side * side);
}
BENCHMARK(film_add);

void film_develop(benchmark::State& state) {
  Film film(side, side);
  add_to_every_pixel(film);
  add_to_every_pixel(film);
  for (auto _ : state) benchmark::DoNotOptimize(film.develop());
  state.SetItemsProcessed(state.iterations() * side * side);
}
BENCHMARK(film_develop);

}  // namespace
}  // namespace photonproof::inline renderer_sensor
