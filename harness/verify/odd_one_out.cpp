#include "harness/verify/odd_one_out.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace photonproof::inline harness_verify {
namespace {

class Table {
 public:
  Table(const std::vector<Witness>& witnesses, const std::vector<WitnessPair>& pairs)
      : witnesses_(witnesses), pairs_(pairs) {}

  PairVerdict between(std::size_t a, std::size_t b) const {
    for (const WitnessPair& pair : pairs_)
      if ((pair.first == a && pair.second == b) || (pair.first == b && pair.second == a)) return pair.verdict;
    return PairVerdict::undecided;
  }
  bool differs_from_any(std::size_t a, const std::vector<std::size_t>& others) const {
    return std::ranges::any_of(others, [&](std::size_t b) { return b != a && between(a, b) == PairVerdict::differ; });
  }
  bool any_differs(const std::vector<std::size_t>& group, const std::vector<std::size_t>& others) const {
    return std::ranges::any_of(group, [&](std::size_t a) { return differs_from_any(a, others); });
  }
  /// No two differ, and certain agreements connect them all.
  bool agree_among_themselves(const std::vector<std::size_t>& group) const {
    if (any_differs(group, group)) return false;
    std::vector<std::size_t> reached{group.front()}, left(group.begin() + 1, group.end());
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const auto agrees = [&](std::size_t b) { return between(reached[i], b) == PairVerdict::agree; };
      std::ranges::copy_if(left, std::back_inserter(reached), agrees);
      std::erase_if(left, agrees);
    }
    return left.empty();
  }
  std::size_t ways(const std::vector<std::size_t>& group) const {
    std::set<std::string> samplings;
    for (const std::size_t a : group) samplings.insert(witnesses_[a].sampling);
    return samplings.size();
  }
  bool has_closed_form(const std::vector<std::size_t>& group) const {
    return std::ranges::any_of(group, [&](std::size_t a) { return witnesses_[a].is_closed_form; });
  }

 private:
  const std::vector<Witness>& witnesses_;
  const std::vector<WitnessPair>& pairs_;
};

std::vector<std::size_t> members(const std::vector<std::size_t>& of, std::size_t mask) {
  std::vector<std::size_t> group;
  for (std::size_t i = 0; i < of.size(); ++i)
    if ((mask >> i & 1U) != 0) group.push_back(of[i]);
  return group;
}

/// The group that agrees among itself in the most ways; a closed form outweighs all ways. If some differ, it is a group
/// that one of them differs from. Empty if an equal group differs from it, or if there are fewer than two ways.
/// Precondition: at most 20.
std::vector<std::size_t> believed_of(const Table& table, const std::vector<std::size_t>& all,
                                     const std::vector<std::size_t>& differing) {
  std::vector<std::size_t> best;
  std::size_t best_rank = 0;
  bool tied = false;
  for (std::size_t mask = (std::size_t{1} << all.size()) - 1; mask > 0; --mask) {
    const std::vector<std::size_t> group = members(all, mask);
    if (!table.agree_among_themselves(group)) continue;
    if (!differing.empty() && !table.any_differs(differing, group)) continue;
    const std::size_t rank = table.ways(group) + (table.has_closed_form(group) ? 100 : 0);
    const bool is_part = std::ranges::includes(best, group);
    if (rank > best_rank || (rank == best_rank && group.size() > best.size() && std::ranges::includes(group, best))) {
      best = group;
      best_rank = rank;
      tied = false;
    } else if (rank == best_rank && !is_part && table.any_differs(group, best)) {
      tied = true;
    }
  }
  return tied || best_rank < 2 ? std::vector<std::size_t>{} : best;
}

}  // namespace

OddOnes odd_ones(const std::vector<Witness>& witnesses, const std::vector<WitnessPair>& pairs) {
  const Table table(witnesses, pairs);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < witnesses.size(); ++i) all.push_back(i);
  OddOnes out;
  for (const std::size_t a : all)
    if (table.differs_from_any(a, all)) out.odd.push_back(a);
  const std::vector<std::size_t> believed = believed_of(table, all, out.odd);
  if (out.odd.empty()) {
    out.believed = believed;
    out.end = believed.empty() ? OddOnes::End::cannot_tell : OddOnes::End::agree;
    return out;
  }
  if (believed.empty()) return out;
  std::vector<std::size_t> odd;
  for (const std::size_t a : out.odd)
    if (table.differs_from_any(a, believed)) odd.push_back(a);
  out.believed = believed;
  out.odd = odd;
  out.by_closed_form = table.has_closed_form(believed);
  out.end = OddOnes::End::odd;
  return out;
}

OddOnes decided_by_known_wrong(const OddOnes& open, const std::vector<std::size_t>& wrong,
                               const std::vector<WitnessPair>& pairs) {
  std::vector<std::size_t> right;
  for (const std::size_t a : open.odd)
    if (std::ranges::find(wrong, a) == wrong.end()) right.push_back(a);
  if (wrong.empty() || right.empty() || Table({}, pairs).any_differs(right, right)) return open;
  return {OddOnes::End::odd, wrong, right, false};
}

}  // namespace photonproof::inline harness_verify
