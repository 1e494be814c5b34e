#include "harness/cells/cells.h"

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <deque>
#include <map>
#include <random>

namespace photonproof::inline harness_cells {

std::string length_prefixed(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all.append(std::to_string(text.size())).append(":").append(text);
  return all;
}

std::string engine_content(const Engine& engine) {
  return length_prefixed(engine.command) + (engine.layer.empty() ? "" : length_prefixed({"layer", engine.layer}));
}

std::string content_key(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string content;
  for (const auto& [name, text] : parts) content += length_prefixed({name, text});
  std::string key = to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(content));
  std::erase(key, '-');
  return key;
}

std::vector<Cell> interleaved_by_engine(const std::vector<Cell>& cells, std::uint64_t seed) {
  std::vector<std::pair<std::string, std::deque<Cell>>> queues;  // by engine, in order of first appearance
  for (const Cell& cell : cells) {
    const auto same_engine = [&](const auto& queue) { return queue.first == cell.engine; };
    auto queue = std::find_if(queues.begin(), queues.end(), same_engine);
    if (queue == queues.end()) queue = queues.insert(queues.end(), {cell.engine, {}});
    queue->second.push_back(cell);
  }
  // A hash of the cell's place that is the same for every engine.
  const auto place = [seed](const Cell& cell) {
    Cell anyones = cell;
    anyones.engine.clear();
    return content_key({{std::to_string(seed), anyones.label()}});
  };
  for (auto& [engine, queue] : queues) {
    std::multimap<std::string, Cell> by_place;
    for (Cell& cell : queue) by_place.emplace(place(cell), std::move(cell));
    queue.clear();
    for (auto& [key, cell] : by_place) queue.push_back(std::move(cell));
  }

  std::mt19937_64 generator(seed);
  std::vector<Cell> ordered;
  for (int round = 0; ordered.size() < cells.size(); ++round) {
    if (round % 2 == 0) {
      // std::shuffle differs between libraries.
      for (std::size_t i = queues.size(); i > 1; --i) std::swap(queues[i - 1], queues[generator() % i]);
    } else {
      std::reverse(queues.begin(), queues.end());
    }
    for (auto& [engine, queue] : queues) {
      if (queue.empty()) continue;
      ordered.push_back(std::move(queue.front()));
      queue.pop_front();
    }
  }
  return ordered;
}

}  // namespace photonproof::inline harness_cells
