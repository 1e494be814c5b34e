// Passes that need not be proved again: most builds change nothing. A verdict follows from the images, so a gate whose
// first images are, bit for bit, those of an earlier pass passes as that one did. Only these are drawn again: one of a
// scene, engine and budget, and two, of two seeds, of an engine's first in the suite, so that an engine that no longer
// heeds its seed is seen. A change that none of their paths meets is not: one that a path meets with probability p
// stays hidden with (1 - p)^n, and n is 65536 at 64 x 64 pixels and 16 samples.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "harness/gates/gate_images.h"
#include "harness/gates/gate_look.h"

namespace photonproof::inline harness_gates {

/// How many images are drawn before an accepted verdict is looked for: the same whichever gates of the suite run.
std::size_t images_to_accept(const GateSuite& suite, const Gate& gate);

/// What a verdict follows from: the gate's settings, the reference, how images are judged (a hash of the harness's
/// sources: a change there is judged anew), the seeds, and the bits of the images. What the engine's version is, or how
/// it came to these images, does not matter. Images of status ok.
std::string verdict_key(const Gate& gate, const GateSuite& suite, const StoredReference& reference,
                        const ParameterValues& viewing, std::span<const std::unique_ptr<DrawnImage>> first_images);

/// <cache>/verdicts/<key>.json: the record of a run, with the one gate that passed and without pictures. Empty when
/// there is none, or none that can be read.
std::optional<Results> find_accepted(const std::string& key);

/// Throws InputError when it cannot be written.
void keep_accepted(const std::string& key, Results run, GateRecord passed);

}  // namespace photonproof::inline harness_gates
