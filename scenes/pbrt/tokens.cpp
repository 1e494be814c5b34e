#include "scenes/pbrt/tokens.h"

#include <algorithm>
#include <utility>

namespace photonproof::inline scenes_pbrt {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }
bool ends_word(char c) { return is_blank(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

char escaped(char c) {
  switch (c) {
    case 'n':
      return '\n';
    case 't':
      return '\t';
    case 'r':
      return '\r';
    default:
      return c;
  }
}

}  // namespace

PbrtToken PbrtTokens::next() {
  if (std::exchange(has_peeked_, false)) return std::move(peeked_);
  return read();
}

const PbrtToken& PbrtTokens::peek() {
  if (!has_peeked_) {
    peeked_ = read();
    has_peeked_ = true;
  }
  return peeked_;
}

PbrtToken PbrtTokens::read() {
  while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#'))
    if (text_[at_] == '#')
      at_ = std::min(text_.find('\n', at_), text_.size());
    else
      ++at_;
  PbrtToken token;
  token.at = {file_, at_};
  if (at_ == text_.size()) return token;
  const char first = text_[at_];
  if (first == '"') return read_string();
  if (first == '[' || first == ']') {
    token.kind = first == '[' ? PbrtToken::Kind::open : PbrtToken::Kind::close;
    ++at_;
    return token;
  }
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
  token.kind = PbrtToken::Kind::word;
  token.word = text_.substr(begin, at_ - begin);
  return token;
}

PbrtToken PbrtTokens::read_string() {
  PbrtToken token;
  token.at = {file_, at_};
  token.kind = PbrtToken::Kind::text;
  for (++at_; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
    if (text_[at_] == '"') {
      ++at_;
      return token;
    }
    if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n')
      ++at_, token.text += escaped(text_[at_]);
    else
      token.text += text_[at_];
  }
  sources_.fail(token.at, "the string has no end in its line");
}

}  // namespace photonproof::inline scenes_pbrt
