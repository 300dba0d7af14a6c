#include "isolux/filter/denoiser.h"

#include <array>
#include <cstddef>

#include <dlfcn.h>

#include "isolux/base/error.h"

namespace isolux {

namespace {

// The part of the library's C interface that is used: opaque handles, and numbers of its enums.
using Device = void*;
using Filter = void*;
using Buffer = void*;

constexpr int cpu_device = 1;
constexpr int no_error = 0;
constexpr int format_float3 = 3;

struct Functions {
    Device (*new_device)(int type) = nullptr;
    void (*commit_device)(Device) = nullptr;
    int (*device_error)(Device, const char** message) = nullptr;
    void (*release_device)(Device) = nullptr;
    Buffer (*new_buffer)(Device, std::size_t bytes) = nullptr;
    void* (*buffer_data)(Buffer) = nullptr;
    void (*release_buffer)(Buffer) = nullptr;
    Filter (*new_filter)(Device, const char* type) = nullptr;
    void (*set_image)(Filter,
                      const char* name,
                      Buffer,
                      int format,
                      std::size_t width,
                      std::size_t height,
                      std::size_t offset,
                      std::size_t pixel_stride,
                      std::size_t row_stride) = nullptr;
    void (*set_bool)(Filter, const char* name, bool value) = nullptr;
    void (*commit_filter)(Filter) = nullptr;
    void (*execute)(Filter) = nullptr;
    void (*release_filter)(Filter) = nullptr;
};

struct CloseLibrary {
    void operator()(void* library) const noexcept { dlclose(library); }
};

using Library = std::unique_ptr<void, CloseLibrary>;

template <class F> void find(void* library, const char* name, F& function) {
    function = reinterpret_cast<F>(dlsym(library, name));
    if (function == nullptr)
        throw DeviceError(std::string("Open Image Denoise: the function ") + name
                          + " is missing (another version than 2?)");
}

Functions find_all(void* library) {
    Functions f;
    find(library, "oidnNewDevice", f.new_device);
    find(library, "oidnCommitDevice", f.commit_device);
    find(library, "oidnGetDeviceError", f.device_error);
    find(library, "oidnReleaseDevice", f.release_device);
    find(library, "oidnNewBuffer", f.new_buffer);
    find(library, "oidnGetBufferData", f.buffer_data);
    find(library, "oidnReleaseBuffer", f.release_buffer);
    find(library, "oidnNewFilter", f.new_filter);
    find(library, "oidnSetFilterImage", f.set_image);
    find(library, "oidnSetFilterBool", f.set_bool);
    find(library, "oidnCommitFilter", f.commit_filter);
    find(library, "oidnExecuteFilter", f.execute);
    find(library, "oidnReleaseFilter", f.release_filter);
    return f;
}

} // namespace

struct OpenImageDenoise::Implementation {
    Library library;
    Functions f;
    Device device = nullptr;
    Filter filter = nullptr; ///< of one resolution
    PictureSize size;
    std::array<Buffer, 4> buffers{}; ///< colour, albedo, normal, output

    ~Implementation() {
        forget_filter();
        if (device != nullptr)
            f.release_device(device);
    }

    void forget_filter() {
        if (filter != nullptr)
            f.release_filter(filter);
        filter = nullptr;
        for (Buffer& b : buffers) {
            if (b != nullptr)
                f.release_buffer(b);
            b = nullptr;
        }
    }

    void expect_success() const {
        const char* message = nullptr;
        if (f.device_error(device, &message) != no_error)
            throw DeviceError(std::string("Open Image Denoise: ")
                              + (message != nullptr ? message : "unknown error"));
    }

    void make_filter(PictureSize wanted) {
        if (filter != nullptr && size == wanted)
            return;
        forget_filter();
        size = wanted;
        filter = f.new_filter(device, "RT");
        constexpr std::array<const char*, 4> names{"color", "albedo", "normal", "output"};
        for (std::size_t i = 0; i < names.size(); ++i) {
            buffers[i] = f.new_buffer(device, 3 * sizeof(float) * size.pixels());
            f.set_image(
                filter, names[i], buffers[i], format_float3, size.columns, size.rows, 0, 0, 0);
        }
        f.set_bool(filter, "hdr", true);
        expect_success();
    }

    void fill(std::size_t buffer, const Planes3& planes) const {
        auto* p = static_cast<float*>(f.buffer_data(buffers[buffer]));
        for (std::size_t i = 0; i < size.pixels(); ++i) {
            p[3 * i] = planes.x[i];
            p[3 * i + 1] = planes.y[i];
            p[3 * i + 2] = planes.z[i];
        }
    }
};

OpenImageDenoise::OpenImageDenoise(const std::string& file)
    : implementation_(std::make_unique<Implementation>()) {
    implementation_->library.reset(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE));
    if (!implementation_->library)
        throw DeviceError("Open Image Denoise 2 is not on this machine (" + file
                          + " cannot be loaded). Install it, or use --filter axis-aligned?");
    implementation_->f = find_all(implementation_->library.get());
    implementation_->device = implementation_->f.new_device(cpu_device);
    if (implementation_->device == nullptr)
        throw DeviceError("Open Image Denoise: no device for this machine");
    implementation_->f.commit_device(implementation_->device);
    implementation_->expect_success();
}

OpenImageDenoise::~OpenImageDenoise() = default;
OpenImageDenoise::OpenImageDenoise(OpenImageDenoise&&) noexcept = default;
OpenImageDenoise& OpenImageDenoise::operator=(OpenImageDenoise&&) noexcept = default;

Planes3 OpenImageDenoise::apply(const DenoiserInput& input) {
    Implementation& i = *implementation_;
    i.make_filter(input.size);
    i.fill(0, *input.colour);
    i.fill(1, *input.albedo);
    i.fill(2, *input.normal);
    i.f.set_bool(i.filter, "cleanAux", input.is_noise_free);
    i.f.commit_filter(i.filter);
    i.f.execute(i.filter);
    i.expect_success();
    Planes3 result;
    result.assign(input.size.pixels(), 0.0F);
    const auto* p = static_cast<const float*>(i.f.buffer_data(i.buffers[3]));
    for (std::size_t k = 0; k < input.size.pixels(); ++k) {
        result.x[k] = p[3 * k];
        result.y[k] = p[3 * k + 1];
        result.z[k] = p[3 * k + 2];
    }
    return result;
}

} // namespace isolux
