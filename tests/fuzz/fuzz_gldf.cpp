#include <algorithm>

#include "fuzz_photometry.h"
#include "support/stored_zip.h"

/// Bytes that begin like a container are one; others are product.xml and, after the first NUL,
/// the photometry inside, which a mutation would otherwise hardly reach past the checksums.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with("PK\x03\x04")) {
        isolux::fuzz::run(data, size, "fuzz.gldf");
        return 0;
    }
    const std::size_t cut = std::min(bytes.find('\0'), bytes.size());
    const std::string light = cut < bytes.size() ? bytes.substr(cut + 1) : std::string();
    const std::string zip = isolux::test::stored_zip(
        {{"product.xml", bytes.substr(0, cut)}, {"ldc/a.ies", light}, {"ldc/b.ldt", light}});
    isolux::fuzz::run(
        reinterpret_cast<const std::uint8_t*>(zip.data()), zip.size(), "fuzz.gldf");
    return 0;
}
