#include "reports/view/deflated.h"

#include <zlib.h>

#include <stdexcept>

namespace photonproof::reports::inline reports_view {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  if (status != Z_OK) throw std::runtime_error("zlib cannot compress");
  out.resize(size);
  return out;
}

}  // namespace photonproof::reports::inline reports_view
