#include "reports/grades/zip_file.h"

#include <zlib.h>

#include <stdexcept>

namespace photonproof::inline reports_grades {
namespace {

constexpr std::uint16_t needed_version = 20, made_by_unix = 3 << 8 | 20;
constexpr std::uint16_t deflate_method = 8, utf8_names = 1 << 11;
constexpr std::uint16_t first_of_1980 = 1 << 5 | 1;  // DOS date

void put16(std::string& out, std::uint16_t value) {
  out += static_cast<char>(value & 0xff);
  out += static_cast<char>(value >> 8);
}

void put32(std::string& out, std::size_t value) {
  if (value > 0xffffffffu) throw std::length_error("a zip archive of more than 4 GiB");
  put16(out, static_cast<std::uint16_t>(value & 0xffff));
  put16(out, static_cast<std::uint16_t>(value >> 16));
}

// Deflate without zlib's own header, as in zip files.
std::string raw_deflated(const std::string& bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot deflate");
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int end = deflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END) throw std::runtime_error("zlib cannot deflate");
  return out;
}

// The fields that the local header and the directory's entry share, from the version needed to the lengths.
std::string common_fields(const ZipMember& member, const std::string& packed) {
  std::string fields;
  put16(fields, needed_version);
  put16(fields, utf8_names);
  put16(fields, deflate_method);
  put16(fields, 0);  // midnight
  put16(fields, first_of_1980);
  put32(fields, crc32(0, reinterpret_cast<const Bytef*>(member.bytes.data()), static_cast<uInt>(member.bytes.size())));
  put32(fields, packed.size());
  put32(fields, member.bytes.size());
  put16(fields, static_cast<std::uint16_t>(member.name.size()));
  put16(fields, 0);  // no extra field
  return fields;
}

}  // namespace

std::string zip_bytes(const std::vector<ZipMember>& members) {
  std::string zip, directory;
  for (const ZipMember& member : members) {
    const std::string packed = raw_deflated(member.bytes);
    const std::string fields = common_fields(member, packed);
    directory += "PK\1\2";
    put16(directory, made_by_unix);
    directory += fields;
    put16(directory, 0);  // no comment
    put16(directory, 0);  // first disk
    put16(directory, 0);
    constexpr std::size_t regular_file = 0100000;
    put32(directory, (regular_file | (member.executable ? 0755u : 0644u)) << 16);
    put32(directory, zip.size());
    directory += member.name;
    zip += "PK\3\4" + fields + member.name + packed;
  }
  const std::size_t start = zip.size();
  zip += directory + "PK\5\6";
  put16(zip, 0);
  put16(zip, 0);
  put16(zip, static_cast<std::uint16_t>(members.size()));
  put16(zip, static_cast<std::uint16_t>(members.size()));
  put32(zip, directory.size());
  put32(zip, start);
  put16(zip, 0);
  return zip;
}

}  // namespace photonproof::inline reports_grades
