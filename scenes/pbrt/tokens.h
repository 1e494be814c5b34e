// The words of a pbrt file: directives, numbers, strings and brackets, without comments.
#pragma once

#include <string>
#include <string_view>

#include "scenes/pbrt/sources.h"

namespace photonproof::inline scenes_pbrt {

struct PbrtToken {
  enum class Kind { word, text, open, close, end } kind = Kind::end;
  std::string_view word;  ///< of a `word`, which numbers are, too
  std::string text;       ///< a string's content
  Place at;
};

class PbrtTokens {
 public:
  PbrtTokens(const PbrtSources& sources, std::size_t file)
      : sources_(sources), text_(sources.text(file)), file_(file) {}

  /// Throws InputError where a string does not end in its line.
  PbrtToken next();
  /// The next token, which stays the next one.
  const PbrtToken& peek();
  std::size_t file() const { return file_; }

 private:
  PbrtToken read();
  PbrtToken read_string();

  const PbrtSources& sources_;
  std::string_view text_;
  std::size_t file_, at_ = 0;
  bool has_peeked_ = false;
  PbrtToken peeked_;
};

}  // namespace photonproof::inline scenes_pbrt
