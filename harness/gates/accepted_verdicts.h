// Passes that need no new proof, as most builds change nothing. A verdict follows from the images, so a gate passes if
// its first images are bit-identical to those of an earlier pass. Only these are drawn again: one image of a scene,
// engine and budget. The engine's first gate in the suite draws two, with two seeds, which shows an engine that ignores
// its seed. A change that none of their paths meets stays hidden. If a path meets it with probability p, this has
// probability (1 - p)^n; n is 65536 at 64 x 64 pixels and 16 samples.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "harness/gates/gate_images.h"
#include "harness/gates/gate_look.h"

namespace photonproof::inline harness_gates {

/// The number of images to draw before looking for an accepted verdict. It does not depend on the gates that run.
std::size_t images_to_accept(const GateSuite& suite, const Gate& gate);

/// The key of all inputs of a verdict: the gate's settings, the reference, the seeds, and the bits of the images. It
/// also includes a hash of the harness's sources, so that a change there is judged anew. The engine's version and its
/// way to these images do not count. Precondition: images of status ok.
std::string verdict_key(const Gate& gate, const GateSuite& suite, const StoredReference& reference,
                        const ParameterValues& viewing, std::span<const std::unique_ptr<DrawnImage>> first_images);

/// <cache>/verdicts/<key>.json: the record of a run, with the one gate that passed and without pictures. Empty without
/// a readable record.
std::optional<Results> find_accepted(const std::string& key);

/// Throws InputError when it cannot be written.
void keep_accepted(const std::string& key, Results run, GateRecord passed);

}  // namespace photonproof::inline harness_gates
