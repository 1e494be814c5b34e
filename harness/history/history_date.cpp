#include "harness/history/history_date.h"

#include <chrono>
#include <optional>
#include <regex>

#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_history {

std::int64_t parse_date(const std::string& where, const std::string& text) {
  static const std::regex form(
      R"((\d{4})-(\d\d)-(\d\d)(?:[T ](\d\d):(\d\d):(\d\d)(?:\.\d{1,9})?(?:(Z)|([+-])(\d\d):?(\d\d)))?)");
  std::smatch part;
  const InputError wrong(where, in_quotes(text) + " is no date, expected such as 2026-11-29T12:33:53Z or 2026-11-29");
  if (text.size() > 64 || !std::regex_match(text, part, form)) throw wrong;
  const auto number = [&](std::size_t i) { return part[i].matched ? std::stoi(part[i].str()) : 0; };
  using namespace std::chrono;
  const year_month_day date{year(number(1)), month(static_cast<unsigned>(number(2))),
                            day(static_cast<unsigned>(number(3)))};
  if (!date.ok() || number(1) < 1970 || number(4) > 23 || number(5) > 59 || number(6) > 60 || number(9) > 23 ||
      number(10) > 59)
    throw wrong;
  const int offset_minutes = (part[8].str() == "-" ? -1 : 1) * (60 * number(9) + number(10));
  const std::int64_t days = sys_days(date).time_since_epoch().count();
  return ((days * 24 + number(4)) * 60 + number(5) - offset_minutes) * 60 + number(6);
}

}  // namespace photonproof::inline harness_history
