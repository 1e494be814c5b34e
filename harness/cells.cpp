#include "harness/cells.h"

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <deque>

namespace photonproof {

std::string content_key(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string content;
  for (const auto& [name, text] : parts) {
    // Lengths first, so that no text can pose as the next part.
    for (const std::string& piece : {name, text})
      content.append(std::to_string(piece.size())).append(":").append(piece);
  }
  std::string key = to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(content));
  std::erase(key, '-');
  return key;
}

std::vector<Cell> interleaved_by_engine(const std::vector<Cell>& cells) {
  std::vector<std::pair<std::string, std::deque<Cell>>> queues;  // by engine, in order of first appearance
  for (const Cell& cell : cells) {
    const auto same_engine = [&](const auto& queue) { return queue.first == cell.engine; };
    auto queue = std::find_if(queues.begin(), queues.end(), same_engine);
    if (queue == queues.end()) queue = queues.insert(queues.end(), {cell.engine, {}});
    queue->second.push_back(cell);
  }
  std::vector<Cell> ordered;
  while (ordered.size() < cells.size()) {
    for (auto& [engine, queue] : queues) {
      if (queue.empty()) continue;
      ordered.push_back(std::move(queue.front()));
      queue.pop_front();
    }
    std::reverse(queues.begin(), queues.end());
  }
  return ordered;
}

}  // namespace photonproof
