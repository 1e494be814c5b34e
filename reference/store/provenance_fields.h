// The members of a reference's provenance (reference/store/provenance.h), in the form that
// scenes/records/record_note.h defines for records.
#pragma once

#include "reference/store/provenance.h"
#include "scenes/records/record_note.h"

namespace photonproof::inline reference_store {

template <class V>
void describe(V& v, Acceptance& r) {
  v.record("acceptance", "one time that somebody replaced the reference by another, and why");
  v.field("date", r.date);
  v.field("reason", r.reason);
  v.field("before", r.before);
  v.field("after", r.after);
}

template <class V>
void describe(V& v, ReferenceWitness& r) {
  v.record("witness", "an estimator that shares no sampling path with the first, and agrees with it");
  v.field("estimator", r.estimator);
  v.field("samples", r.samples, {.says = "a pixel"});
  v.field("standard_error", r.standard_error, {.says = "relative"});
  v.maybe("would_see", r.would_see, {.says = "the least relative error that shows with probability 0.99"});
}

template <class V>
void describe(V& v, GivenImages& r) {
  v.record("given images", "the images of a reference that none of our own integrators rendered");
  v.field("noise", r.noise, {.says = "images (from their differences), stated (by a variance image) or unknown"});
  v.field("images", r.images, {.says = "the images of which the mean is taken"});
  v.field("files", r.files, {.says = "names without folders; none where an engine rendered the images"});
  v.field("checksums", r.checksums, {.says = "one a file"});
  v.maybe("transfer", r.transfer, {.says = "the function that values were decoded from"});
  v.maybe("command", r.command, {.says = "the command of the engine's first image"});
}

template <class V>
void describe(V& v, Provenance& r) {
  v.record("photonproof reference", "Where a stored reference comes from: the JSON beside its EXR.");
  v.version("format", 1);
  v.field("scene_hash", r.scene_hash);
  v.field("width", r.width, {.least = 0});
  v.field("height", r.height, {.least = 0});
  v.field("estimator", r.estimator);
  v.field("samples", r.samples, {.says = "a pixel, in all batches"});
  v.field("standard_error", r.standard_error, {.says = "relative, of the pixels as stored"});
  v.field("date", r.date, {.says = "UTC, ISO 8601"});
  v.field("host", r.host);
  v.field("versions", r.versions);
  v.field("pixels", r.pixels, {.says = "checksum of the stored mean and variance"});
  v.field("history", r.acceptances, {.says = "oldest first"});
  v.field("seeds", r.seeds, {.says = "one an independent batch"});
  v.maybe("bias", r.bias, {.says = "relative, by the estimator itself"});
  v.maybe("witness", r.witness);
  v.maybe("given", r.given);
  v.maybe("definitions", r.definitions, {.says = "name=value of -D"});
}

}  // namespace photonproof::inline reference_store
