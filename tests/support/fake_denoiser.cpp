// Stands in for Intel Open Image Denoise 2: the same C functions, and in place of its network
// the mean of colour and normal, so that a test sees what arrived. It refuses what the real one
// would do badly with: pictures without "hdr", albedo out of range, images missing.

#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

struct FakeDevice {
    bool is_committed = false;
    std::string error;
};

struct FakeBuffer {
    std::vector<float> values;
};

struct FakeFilter {
    FakeDevice* device = nullptr;
    std::map<std::string, FakeBuffer*> images;
    std::map<std::string, bool> flags;
    std::size_t pixels = 0;
    bool is_committed = false;
};

} // namespace

extern "C" {

void* oidnNewDevice(int) { return new FakeDevice; }

void oidnCommitDevice(void* d) { static_cast<FakeDevice*>(d)->is_committed = true; }

int oidnGetDeviceError(void* d, const char** message) {
    const auto* device = static_cast<FakeDevice*>(d);
    *message = device->error.c_str();
    return device->error.empty() ? 0 : 2;
}

void oidnReleaseDevice(void* d) { delete static_cast<FakeDevice*>(d); }

void* oidnNewBuffer(void*, std::size_t bytes) {
    return new FakeBuffer{std::vector<float>(bytes / sizeof(float))};
}

void* oidnGetBufferData(void* b) { return static_cast<FakeBuffer*>(b)->values.data(); }

void oidnReleaseBuffer(void* b) { delete static_cast<FakeBuffer*>(b); }

void* oidnNewFilter(void* d, const char* type) {
    auto* device = static_cast<FakeDevice*>(d);
    if (!device->is_committed || std::strcmp(type, "RT") != 0)
        device->error = "device not committed, or unknown filter";
    return new FakeFilter{device, {}, {}, 0, false};
}

void oidnSetFilterImage(void* f,
                        const char* name,
                        void* buffer,
                        int format,
                        std::size_t width,
                        std::size_t height,
                        std::size_t,
                        std::size_t,
                        std::size_t) {
    auto* filter = static_cast<FakeFilter*>(f);
    if (format != 3)
        filter->device->error = "format is not three floats";
    filter->images[name] = static_cast<FakeBuffer*>(buffer);
    filter->pixels = width * height;
}

void oidnSetFilterBool(void* f, const char* name, bool value) {
    static_cast<FakeFilter*>(f)->flags[name] = value;
}

void oidnCommitFilter(void* f) { static_cast<FakeFilter*>(f)->is_committed = true; }

void oidnExecuteFilter(void* f) {
    auto* filter = static_cast<FakeFilter*>(f);
    auto& i = filter->images;
    if (!filter->is_committed || !filter->flags["hdr"] || filter->flags.count("cleanAux") == 0
        || i["color"] == nullptr || i["albedo"] == nullptr || i["normal"] == nullptr
        || i["output"] == nullptr) {
        filter->device->error = "not set up for linear light with albedo and normal";
        return;
    }
    for (std::size_t k = 0; k < 3 * filter->pixels; ++k) {
        if (i["albedo"]->values[k] < 0.0F || i["albedo"]->values[k] > 1.0F)
            filter->device->error = "albedo out of range";
        i["output"]->values[k] = 0.5F * (i["color"]->values[k] + i["normal"]->values[k]);
    }
}

void oidnReleaseFilter(void* f) { delete static_cast<FakeFilter*>(f); }

} // extern "C"
