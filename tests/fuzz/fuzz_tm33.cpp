#include "fuzz_photometry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    isolux::fuzz::run(data, size, "fuzz.xml");
    return 0;
}
