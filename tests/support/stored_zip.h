#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A ZIP container with uncompressed entries, byte for byte as APPNOTE.TXT 4.3 lays it out.
namespace isolux::test {

inline std::uint32_t crc32_of(std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

inline void put(std::string& to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i)
        to.push_back(static_cast<char>(value >> (8 * i)));
}

struct ZipFile {
    std::string name;
    std::string bytes;
    std::uint32_t claimed_size = 0; ///< a lie about the unpacked size; 0: the truth
};

inline std::string stored_zip(const std::vector<ZipFile>& files) {
    std::string local, directory;
    for (const ZipFile& f : files) {
        std::string common;
        put(common, 20, 2); // version needed
        put(common, 0, 2);  // flags
        put(common, f.claimed_size == 0 ? 0 : 8, 2);
        put(common, 0, 4); // time and date
        put(common, crc32_of(f.bytes), 4);
        put(common, f.bytes.size(), 4);
        put(common, f.claimed_size == 0 ? f.bytes.size() : f.claimed_size, 4);
        put(common, f.name.size(), 2);
        put(common, 0, 2); // extra field
        put(directory, 0x02014b50, 4);
        put(directory, 20, 2);
        directory += common;
        put(directory, 0, 2); // comment
        put(directory, 0, 2); // disk
        put(directory, 0, 2);
        put(directory, 0, 4);
        put(directory, local.size(), 4);
        directory += f.name;
        put(local, 0x04034b50, 4);
        local += common + f.name + f.bytes;
    }
    std::string end;
    put(end, 0x06054b50, 4);
    put(end, 0, 4);
    put(end, files.size(), 2);
    put(end, files.size(), 2);
    put(end, directory.size(), 4);
    put(end, local.size(), 4);
    put(end, 0, 2);
    return local + directory + end;
}

} // namespace isolux::test
