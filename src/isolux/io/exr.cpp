#include "isolux/io/exr.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include "isolux/base/error.h"
#include "isolux/base/parallel.h"
#include "isolux/io/safe_file.h"
#include "isolux/io/text_file.h"

namespace isolux {

namespace {

constexpr int most_pixels = 16384; ///< a side
constexpr std::uintmax_t largest_file = 16'000'000'000;

/// Collects a file in memory, so that it reaches the disk whole or not at all.
class MemoryOut : public Imf::OStream {
public:
    MemoryOut() : OStream("memory") {}

    void write(const char* c, int n) override {
        const auto count = static_cast<std::size_t>(n);
        if (at_ + count > bytes_.size())
            bytes_.resize(at_ + count);
        std::memcpy(bytes_.data() + at_, c, count);
        at_ += count;
    }

    std::uint64_t tellp() override { return at_; }

    void seekp(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }

    [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

/// Reads a file that is in memory.
class MemoryIn : public Imf::IStream {
public:
    MemoryIn(const std::string& bytes, const char* name) : IStream(name), bytes_(bytes) {}

    bool read(char* c, int n) override {
        const auto count = static_cast<std::size_t>(n);
        if (count > bytes_.size() - std::min(at_, bytes_.size()))
            throw std::runtime_error("the file ends early");
        std::memcpy(c, bytes_.data() + at_, count);
        at_ += count;
        return at_ < bytes_.size();
    }

    std::uint64_t tellg() override { return at_; }

    void seekg(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }

private:
    const std::string& bytes_;
    std::size_t at_ = 0;
};

/// Of zip: two thirds of the time of the usual level for a percent more bytes.
constexpr int fast_level = 2;

/// The header and the frame buffer of a file, channel by channel.
class Layers {
public:
    explicit Layers(PictureSize size)
        : size_(size), header(static_cast<int>(size.columns), static_cast<int>(size.rows)) {
        header.compression() = Imf::ZIP_COMPRESSION;
        header.zipCompressionLevel() = fast_level;
        Imf::addWhiteLuminance(header, 1.0F);
        Imf::addChromaticities(header, Imf::Chromaticities()); // Rec. 709, D65
    }

    void add(const std::string& name, const Plane& plane) {
        if (plane.size() == size_.pixels())
            insert(name, Imf::FLOAT, reinterpret_cast<const char*>(plane.data()));
    }

    void add(const std::string& name, const std::vector<std::uint32_t>& plane) {
        if (plane.size() == size_.pixels())
            insert(name, Imf::UINT, reinterpret_cast<const char*>(plane.data()));
    }

    /// `prefix` with a dot at its end, or empty.
    void add_colours(const std::string& prefix, const Planes3& planes) {
        add(prefix + "R", planes.x);
        add(prefix + "G", planes.y);
        add(prefix + "B", planes.z);
    }

    void add_vectors(const std::string& prefix, const Planes3& planes) {
        add(prefix + "X", planes.x);
        add(prefix + "Y", planes.y);
        add(prefix + "Z", planes.z);
    }

    void add_luminance(const std::string& name, const Planes3& planes) {
        constexpr std::size_t grain = 4096; // pixels
        Plane y(planes.x.size());
        for_each_index(y.size(), grain, [&](std::size_t i) {
            y[i] = static_cast<float>(luminance_sum(planes.colour(i)));
        });
        kept_.push_back(std::move(y));
        add(name, kept_.back());
    }

private:
    void insert(const std::string& name, Imf::PixelType type, const char* data) {
        header.channels().insert(name, Imf::Channel(type));
        // The library's slices are not const, though it only reads from them here.
        buffer.insert(name,
                      Imf::Slice(type,
                                 const_cast<char*>(data), // NOLINT
                                 sizeof(float),
                                 sizeof(float) * size_.columns));
    }

    PictureSize size_;
    std::deque<Plane> kept_;

public:
    Imf::Header header;
    Imf::FrameBuffer buffer;
};

void add_attributes(Imf::Header& header, const ViewPicture& picture) {
    header.insert("software", Imf::StringAttribute("isolux " ISOLUX_VERSION));
    header.insert("view", Imf::StringAttribute(picture.view));
    if (!picture.filter.empty())
        header.insert("filterName", Imf::StringAttribute(picture.filter));
    if (picture.interrupted)
        header.insert("comments", Imf::StringAttribute("stopped before it was finished"));
    header.insert("objectNames", Imf::StringVectorAttribute(picture.object_names));
}

} // namespace

const Plane* ExrImage::find(std::string_view name) const noexcept {
    for (const ExrChannel& c : channels)
        if (c.name == name)
            return &c.values;
    return nullptr;
}

void write_exr(const std::filesystem::path& path, const ViewPicture& picture) {
    Layers layers(picture.size);
    layers.add_colours("", picture.shown());
    layers.add("Z", picture.depth);
    layers.add_colours("raw.", picture.raw);
    layers.add("error.Y", picture.standard_error);
    layers.add("error.filtered", picture.filtered_error);
    layers.add_colours("albedo.", picture.albedo);
    layers.add_vectors("normal.", picture.normal);
    layers.add("object.id", picture.object);
    layers.add("illuminance.E",
               picture.filtered_illuminance.empty() ? picture.illuminance
                                                    : picture.filtered_illuminance);
    layers.add("samples.N", picture.samples);
    layers.add_luminance("luminance.Y", picture.shown());
    layers.add_luminance("raw.Y", picture.raw);
    layers.add_colours("filtered.", picture.filtered);
    layers.add_luminance("filtered.Y", picture.filtered);
    layers.add("filter.width", picture.filter_width);
    layers.add_colours("emission.", picture.emission);
    layers.add_colours("direct.", picture.direct);
    layers.add_colours("indirect.", picture.indirect);
    layers.add_vectors("position.", picture.position);
    add_attributes(layers.header, picture);
    MemoryOut out;
    try {
        const auto threads = static_cast<int>(allowed_threads());
        if (Imf::globalThreadCount() < threads)
            Imf::setGlobalThreadCount(threads);
        Imf::OutputFile file(out, layers.header, threads);
        file.setFrameBuffer(layers.buffer);
        file.writePixels(static_cast<int>(picture.size.rows));
    } catch (const std::exception& e) {
        throw DeviceError(path.string() + ": OpenEXR cannot write the picture (" + e.what()
                          + ")");
    }
    write_file_safely(path, out.bytes());
}

ExrImage read_exr(const std::filesystem::path& path) {
    const std::string bytes = read_file_bytes(path, largest_file);
    const std::string name = path.string();
    try {
        MemoryIn in(bytes, name.c_str());
        Imf::InputFile file(in);
        const Imath::Box2i window = file.header().dataWindow();
        const int width = window.max.x - window.min.x + 1;
        const int height = window.max.y - window.min.y + 1;
        if (width > most_pixels || height > most_pixels)
            throw InputError(name,
                             std::to_string(width) + " x " + std::to_string(height)
                                 + " pixels are too many (at most 16384 a side)");
        ExrImage image;
        image.size = {static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
        const Imf::ChannelList& list = file.header().channels();
        for (auto c = list.begin(); c != list.end(); ++c)
            if (c.channel().xSampling == 1 && c.channel().ySampling == 1)
                image.channels.push_back({c.name(), Plane(image.size.pixels())});
        Imf::FrameBuffer buffer;
        for (ExrChannel& c : image.channels) {
            // The library counts from pixel (0, 0), wherever the data window lies.
            char* base = reinterpret_cast<char*>(c.values.data())
                         - (static_cast<std::ptrdiff_t>(window.min.y) * width + window.min.x)
                               * static_cast<std::ptrdiff_t>(sizeof(float));
            buffer.insert(c.name,
                          Imf::Slice(Imf::FLOAT,
                                     base,
                                     sizeof(float),
                                     sizeof(float) * static_cast<std::size_t>(width)));
        }
        file.setFrameBuffer(buffer);
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& e) {
        throw InputError(name,
                         std::string("not a readable OpenEXR picture (") + e.what() + ")");
    }
}

} // namespace isolux
