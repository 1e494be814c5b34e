#include "scenes/pbrt/parameters.h"

#include <algorithm>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_pbrt {
namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_type_of_numbers(std::string_view type) {
  return is_one_of(type, {"float", "point2", "vector2", "point3", "vector3", "normal", "normal3", "point", "vector",
                          "rgb", "blackbody"});
}

/// Words of the declaration "type name".
std::vector<std::string> words_of(const std::string& declaration) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < declaration.size();) {
    const std::size_t begin = declaration.find_first_not_of(" \t", at);
    if (begin == std::string::npos) break;
    at = std::min(declaration.find_first_of(" \t", begin), declaration.size());
    words.push_back(declaration.substr(begin, at - begin));
  }
  return words;
}

}  // namespace

void PbrtParameters::read(PbrtTokens& tokens, PbrtColours colours) {
  while (tokens.peek().kind == PbrtToken::Kind::text) {
    const PbrtToken declaration = tokens.next();
    const std::vector<std::string> words = words_of(declaration.text);
    PbrtParameter parameter;
    parameter.at = declaration.at;
    parameter.colours = colours;
    if (words.size() == 2) parameter.type = words[0], parameter.name = words[1];
    const bool is_known = is_type_of_numbers(parameter.type) ||
                          is_one_of(parameter.type, {"integer", "bool", "string", "texture", "spectrum"});
    read_values(tokens, parameter);
    if (!is_known)
      sources_->fail(declaration.at, what_ + ": " + in_quotes(declaration.text) +
                                         " is no parameter, expected \"TYPE NAME\" with float, integer, bool, string, "
                                         "texture, rgb, spectrum, blackbody, point2, point3, vector3 or normal");
    if (has(parameter.name)) fail(parameter, "is given twice");
    list_.push_back(std::move(parameter));
    read_.push_back(0);
  }
}

void PbrtParameters::read_values(PbrtTokens& tokens, PbrtParameter& parameter) const {
  if (tokens.peek().kind != PbrtToken::Kind::open) {
    const PbrtToken token = tokens.next();
    if (token.kind != PbrtToken::Kind::word && token.kind != PbrtToken::Kind::text)
      sources_->fail(token.at, "expected a value of parameter " + in_quotes(parameter.name));
    return read_value(token, parameter);
  }
  tokens.next();
  for (;;) {
    const PbrtToken token = tokens.next();
    if (token.kind == PbrtToken::Kind::close) return;
    if (token.kind == PbrtToken::Kind::open || token.kind == PbrtToken::Kind::end)
      sources_->fail(token.at, "expected ']' after the values of parameter " + in_quotes(parameter.name));
    read_value(token, parameter);
  }
}

void PbrtParameters::read_value(const PbrtToken& token, PbrtParameter& parameter) const {
  const std::string_view word = token.kind == PbrtToken::Kind::text ? std::string_view(token.text) : token.word;
  const auto refuse = [&](const std::string& what) {
    sources_->fail(token.at, "parameter " + in_quotes(parameter.name) + " " + what);
  };
  if (parameter.type == "bool") {
    if (word != "true" && word != "false") refuse("is " + in_quotes(word) + ", expected true or false");
    parameter.booleans.push_back(word == "true");
  } else if (parameter.type == "string" || parameter.type == "texture" ||
             (parameter.type == "spectrum" && token.kind == PbrtToken::Kind::text)) {
    if (token.kind != PbrtToken::Kind::text) refuse("is " + in_quotes(word) + ", expected a string in quotes");
    parameter.strings.push_back(token.text);
  } else if (token.kind == PbrtToken::Kind::text) {
    refuse("is a string, expected a number");
  } else if (parameter.type == "integer") {
    const Parsed<std::int64_t> value = parse_integer(word);
    if (!value.value) refuse(value.problem);
    parameter.numbers.push_back(static_cast<double>(*value.value));
  } else {
    const Parsed<double> value = parse_number(word);
    if (!value.value) refuse(value.problem);
    parameter.numbers.push_back(*value.value);
  }
}

void PbrtParameters::add_defaults(const std::vector<PbrtParameter>& others) {
  for (const PbrtParameter& other : others)
    if (!has(other.name)) {
      list_.push_back(other);
      read_.push_back(1);  // it may be meant for others
    }
}

const PbrtParameter* PbrtParameters::find(std::string_view name, std::initializer_list<std::string_view> types) const {
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (list_[i].name == name && is_one_of(list_[i].type, types)) {
      read_[i] = 1;
      return &list_[i];
    }
  return nullptr;
}

bool PbrtParameters::has(std::string_view name) const {
  return std::any_of(list_.begin(), list_.end(), [&](const PbrtParameter& p) { return p.name == name; });
}

double PbrtParameters::number(std::string_view name, double fallback) const {
  const PbrtParameter* found = find(name, {"float"});
  if (found == nullptr) return fallback;
  if (found->numbers.size() != 1) fail(*found, "expected one number");
  return found->numbers[0];
}

double PbrtParameters::number(std::string_view name, double fallback, double least, double most) const {
  const double value = number(name, fallback);
  if (value >= least && value <= most) return value;
  fail(*find(name, {"float"}),
       "is " + format_number(value) + ", expected from " + format_number(least) + " to " + format_number(most));
}

int PbrtParameters::integer(std::string_view name, int fallback, int least, int most) const {
  const PbrtParameter* found = find(name, {"integer"});
  if (found == nullptr) return fallback;
  if (found->numbers.size() != 1 || found->numbers[0] < least || found->numbers[0] > most)
    fail(*found, "expected an integer from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(found->numbers[0]);
}

bool PbrtParameters::boolean(std::string_view name, bool fallback) const {
  const PbrtParameter* found = find(name, {"bool"});
  if (found == nullptr) return fallback;
  if (found->booleans.size() != 1) fail(*found, "expected true or false");
  return found->booleans[0];
}

std::string PbrtParameters::text(std::string_view name, const std::string& fallback) const {
  const PbrtParameter* found = find(name, {"string"});
  if (found == nullptr) return fallback;
  if (found->strings.size() != 1) fail(*found, "expected one string");
  return found->strings[0];
}

Vec3d PbrtParameters::point(std::string_view name, const Vec3d& fallback) const {
  const PbrtParameter* found = find(name, {"point3", "point", "vector3", "vector"});
  if (found == nullptr) return fallback;
  if (found->numbers.size() != 3) fail(*found, "expected three numbers");
  return {found->numbers[0], found->numbers[1], found->numbers[2]};
}

std::vector<double> PbrtParameters::numbers(std::string_view name,
                                            std::initializer_list<std::string_view> types) const {
  const PbrtParameter* found = find(name, types);
  return found == nullptr ? std::vector<double>() : found->numbers;
}

void PbrtParameters::ignore(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (is_one_of(list_[i].name, names)) read_[i] = 1;
}

void PbrtParameters::finish() const {
  for (std::size_t i = 0; i < list_.size(); ++i)
    if (!read_[i]) fail(list_[i], "with type " + in_quotes(list_[i].type) + " is not supported here");
}

void PbrtParameters::fail(const PbrtParameter& parameter, const std::string& message) const {
  sources_->fail(parameter.at, what_ + ": parameter " + in_quotes(parameter.name) + " " + message);
}

}  // namespace photonproof::inline scenes_pbrt
