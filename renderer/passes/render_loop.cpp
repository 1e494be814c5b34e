#include "renderer/passes/render_loop.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "renderer/sensor/negative_lobes.h"
#include "scenes/base/input_error.h"
#include "scenes/base/percent_text.h"

namespace photonproof::inline renderer_passes {
namespace {

constexpr double seconds_between_progress = 0.1;

// The largest --spp, where the error decides.
constexpr std::int64_t most_samples = std::int64_t{1} << 32;
// Fewer estimates of a rare event's variance are mostly 0.
constexpr std::int64_t least_samples_for_error = 16;
// Factor on the lasting squared bias below which a squared error needs no more passes: they could remove a tenth of it.
constexpr double enough_of_lasting = 1.25;
// Factor on relmse's epsilon below which an image's mean square is dim: its errors are relative to epsilon rather than
// to the image.
constexpr double dim = 0.1;
// A lasting squared bias above this, a tenth of the image, is reported where no target error was given.
constexpr double much_that_lasts = 0.01;

std::int64_t total_samples(const RenderJob& job) {
  return job.budget.target_error ? most_samples : job.budget.spp.value_or(job.sample_count);
}

const char* kind_of_budget(const RenderBudget& budget) {
  return budget.target_error ? "--target-error" : budget.seconds ? "--seconds" : "--spp";
}

}  // namespace

RenderLoop::RenderLoop(const RenderJob& job, const Threads& threads, Film& film, RenderStats& stats, PassPlan plan)
    : job_(job),
      threads_(threads),
      film_(film),
      stats_(stats),
      plan_(std::move(plan)),
      schedule_(total_samples(job), job.budget.seconds, plan_.longest, plan_.parts) {
  keep(film);
}

void RenderLoop::keep(Film& film) {
  kept_.push_back({[&film](StateWriter& out) { film.save(out); }, [&film](StateReader& in) { film.restore(in); }});
}

bool RenderLoop::next() {
  if (!begun_) {
    begun_ = true;
    if (job_.checkpoint && job_.checkpoint->resume) {
      read_checkpoint(job_.checkpoint->file, job_.checkpoint->identity, [&](StateReader& in) { restore(in); });
      claim_.move_to(job_.checkpoint->file);
      stats_.counts["resumed_from_samples"] = static_cast<double>(schedule_.samples_done());
      stats_.counts["resumed_after_seconds"] = schedule_.seconds_spent();
    }
  } else {
    if (pass_is_open()) return ended(true);
    done_.clear();
    units_done_ = 0;
  }
  samples_ = 0;
  first_negative_ += std::exchange(negative_, 0);
  if (schedule_.samples_done() > 0 && !resumed_pass_ && job_.interrupted()) return ended(true);
  if (!resumed_pass_) pause();
  if (!resumed_pass_ && reached_target()) return ended(false);
  samples_ = schedule_.next();
  if (samples_ == 0) return ended(false);
  const std::int64_t best = negative_samples(plan_.subtracted, schedule_.samples_done()) - first_negative_;
  negative_ = std::max<std::int64_t>(best, plan_.subtracted > 0 && plan_.combines_passes ? 1 : 0);
  for (KeptBetween& kept : between_) std::memcpy(kept.at_start.data(), kept.data, kept.at_start.size());
  if (job_.progress) job_.progress(fraction(0), plan_.phase);
  return true;
}

bool RenderLoop::reached_target() {
  if (!job_.budget.target_error || schedule_.samples_done() < least_samples_for_error) return false;
  error_ = error();
  if (!error_) return false;
  const double lasting = plan_.lasting_bias ? plan_.lasting_bias() : 0;
  return *error_ <= *job_.budget.target_error || *error_ * *error_ <= enough_of_lasting * lasting;
}

void RenderLoop::say_if_dim() {
  const std::optional<double> target = job_.budget.target_error;
  if (!target) return;
  const double square = film_.mean_square();
  if (!(square > 0) || square >= dim * Film::relative_epsilon) return;
  const double of_itself = film_.relative_standard_error(square * Film::relative_epsilon).value_or(0);
  if (of_itself <= *target) return;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "--target-error %.3g is relative to radiances^2 + %.3g, and radiances are about %.2g here: of themselves "
      "pixels err by %s",
      *target, Film::relative_epsilon, std::sqrt(square), percent_text(of_itself).c_str());
  stats_.losses.emplace_back(text);
}

void RenderLoop::say_what_lasts() {
  const std::optional<double> target = job_.budget.target_error;
  const double squared = plan_.lasting_bias ? plan_.lasting_bias() : 0;
  if (target ? !error_ || *error_ <= *target : squared <= much_that_lasts) return;
  char text[320];
  if (target)
    std::snprintf(text, sizeof text,
                  "--target-error %.3g is not reached, the error is %.3g: %.3g of it is what %s wrong, and does not "
                  "fall with more samples",
                  *target, *error_, std::sqrt(squared), plan_.lasting_bias_of().c_str());
  else
    std::snprintf(text, sizeof text, "%s some %s of the image wrong, which does not fall with more samples",
                  plan_.lasting_bias_of().c_str(), percent_text(std::sqrt(squared)).c_str());
  stats_.losses.emplace_back(text);
}

std::optional<double> RenderLoop::error() {
  const std::optional<double> standard_error = film_.relative_standard_error();
  if (!standard_error) return std::nullopt;
  stats_.counts["relative_standard_error"] = *standard_error;
  if (!plan_.squared_bias) return standard_error;
  const double squared_bias = plan_.squared_bias();
  stats_.counts["relative_bias"] = std::sqrt(squared_bias);
  return std::sqrt(*standard_error * *standard_error + squared_bias);
}

// An error falls with the root of the samples.
double RenderLoop::fraction(double part) const {
  if (!job_.budget.target_error) return schedule_.fraction(samples_, part);
  const double ratio = error_ ? *job_.budget.target_error / *error_ : 0;
  return std::min(1.0, ratio * ratio);
}

bool RenderLoop::ended(bool interrupted) {
  stats_.interrupted = interrupted;
  if (interrupted && writes()) write();
  finish_write();
  if (job_.progress && !interrupted) job_.progress(1, plan_.phase);
  rays_.store(stats_);
  if (plan_.squared_bias) error();
  if (!interrupted) {
    say_what_lasts();
    say_if_dim();
  }
  stats_.counts["samples_per_pixel"] = static_cast<double>(schedule_.samples_done());
  if (plan_.subtracted > 0)
    stats_.counts["negative_samples_per_pixel"] = static_cast<double>(first_negative_ + negative_);
  return false;
}

void RenderLoop::begin_units(std::size_t count) {
  if (resumed_pass_ && done_.size() != count)
    throw InputError(job_.checkpoint->file.string(),
                     "the checkpoint is not one of this render: its passes have other parts");
  if (!resumed_pass_) {
    done_.assign(count, 0);
    units_done_ = 0;
  }
  resumed_pass_ = false;
}

void RenderLoop::unit_is_done(std::size_t unit) {
  const std::lock_guard lock(progress_mutex_);
  done_[unit] = 1;
  ++units_done_;
  if (!job_.progress || since_progress_.seconds() < seconds_between_progress) return;
  since_progress_ = Timer();
  const double part = static_cast<double>(units_done_) / static_cast<double>(done_.size());
  job_.progress(std::min(fraction(part), 0.999), plan_.phase);
}

void RenderLoop::for_each_tile(const std::function<void(const Tile&)>& body) {
  const Tiles tiles(film_.window());
  begin_units(tiles.count());
  while (pass_is_open() && !stops()) {
    pause();
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < done_.size(); ++i)
      if (done_[i] == 0) left.push_back(i);
    threads_.for_each(left.size(), [&](std::size_t i) {
      const bool waits = i > 0 && pause_is_due();  // one tile is made however often pauses are due
      if (waits || stops()) return;
      body(tiles.at(left[i]));
      unit_is_done(left[i]);
    });
  }
}

void RenderLoop::for_each_in_order(std::size_t units, const std::function<void(std::size_t, std::size_t)>& body,
                                   const std::function<void(std::size_t, std::size_t)>& commit) {
  begin_units(units);
  while (pass_is_open() && !stops()) {
    pause();
    const std::size_t first = units_done_;
    bool begun = false;
    const auto waits = [&] { return (std::exchange(begun, true) && pause_is_due()) || stops(); };
    threads_.for_each_in_order(
        first, units, waits, [&](std::size_t unit) { body(unit, unit % slots()); },
        [&](std::size_t unit) {
          commit(unit, unit % slots());
          unit_is_done(unit);
        });
  }
}

void RenderLoop::pause() {
  if (checkpoint_is_due()) write();
  if (preview_is_due()) show();
}

void RenderLoop::show() {
  const PhaseTimer phase(stats_.phases["preview"]);
  job_.preview(film_.develop());
  since_preview_ = Timer();
}

void RenderLoop::write() {
  finish_write();
  const PhaseTimer phase(stats_.phases["checkpoint"]);
  fill_checkpoint(content_, job_.checkpoint->identity, [&](StateWriter& out) { save(out); });
  writing_ = std::async(std::launch::async, [this] {
    const Timer timer;
    Written written;
    try {
      write_checkpoint(job_.checkpoint->file, content_, &claim_);
    } catch (const InputError& error) {  // a full disk must not end a render that could still finish
      written.problem = error.summary();
    }
    written.seconds = timer.seconds();
    return written;
  });
  since_write_ = Timer();
}

void RenderLoop::finish_write() {
  if (!writing_.valid()) return;
  const PhaseTimer phase(stats_.phases["checkpoint"]);
  const Written written = writing_.get();
  stats_.checkpoint_problem = written.problem;
  if (written.problem.empty()) stats_.counts["checkpoints"] += 1;
  stats_.counts["checkpoint_write_seconds"] += written.seconds;
}

void RenderLoop::save(StateWriter& out) const {
  out.text(kind_of_budget(job_.budget));
  out.text(plan_.budget);
  out.value(total_samples(job_));
  const bool open = pass_is_open();
  out.value(open ? first() : schedule_.samples_done());
  out.value(open ? samples_ : std::int64_t{0});
  out.value(schedule_.seconds_spent());
  out.value(std::uint64_t{open ? done_.size() : 0});
  out.vector(open ? done_ : std::vector<std::uint8_t>{});
  if (plan_.subtracted > 0) out.value(first_negative_ + (open ? 0 : negative_));
  out.value(rays_.counts());
  for (const KeptBetween& kept : between_) {
    const char* data = open ? kept.at_start.data() : kept.data;
    out.bytes(data, kept.at_start.size());
  }
  for (const Kept& kept : kept_) kept.save(out);
}

void RenderLoop::restore(StateReader& in) {
  const auto expect = [&](const char* name, const std::string& ours) {
    const std::string theirs = in.text();
    if (theirs != ours) in.refuse(std::string("its ") + name + " is " + theirs + ", this render's is " + ours);
  };
  expect("kind of budget", kind_of_budget(job_.budget));
  expect("budget", plan_.budget);
  const auto total = in.value<std::int64_t>();
  const auto first = in.value<std::int64_t>();
  const auto samples = in.value<std::int64_t>();
  const auto seconds = in.value<double>();
  const auto units = in.value<std::uint64_t>();
  if (first < 0 || samples < 0 || units > in.bytes_left()) in.refuse("its pass makes no sense");
  if (!schedule_.makes_pass(first, samples))
    in.refuse("it stands at sample " + std::to_string(first + samples) + " of --spp " + std::to_string(total) +
              ", in a pass that --spp " + std::to_string(total_samples(job_)) + " does not make");
  done_.resize(static_cast<std::size_t>(units));
  in.vector(done_);
  for (std::uint8_t& unit : done_) unit = unit != 0 ? 1 : 0;
  units_done_ = static_cast<std::size_t>(std::count(done_.begin(), done_.end(), 1));
  resumed_pass_ = samples > 0;
  schedule_.resume(first, samples, seconds);
  if (plan_.subtracted > 0) first_negative_ = in.value<std::int64_t>();
  rays_.set(in.value<RayCounts>());
  for (KeptBetween& kept : between_) in.bytes(kept.data, kept.at_start.size());
  for (const Kept& kept : kept_) kept.restore(in);
}

}  // namespace photonproof::inline renderer_passes
