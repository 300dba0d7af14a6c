#include "isolux/io/contributions_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/io/safe_file.h"
#include "isolux/io/sha256.h"
#include "isolux/io/text_file.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kind_words{"group", "type", "luminaire"};

/// Little-endian bytes of floats, whatever the machine's own order.
void append_floats(std::string& bytes, std::span<const float> values) {
    for (const float v : values) {
        auto word = std::bit_cast<std::uint32_t>(v);
        for (int i = 0; i < 4; ++i, word >>= 8U)
            bytes += static_cast<char>(word & 0xffU);
    }
}

float float_at(std::string_view bytes, std::size_t index) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;)
        word = (word << 8U) | static_cast<unsigned char>(bytes[4 * index + i]);
    return std::bit_cast<float>(word);
}

/// Everything of the file before its numbers: magic, version, length, description, padded so
/// that the numbers begin at a multiple of 64 bytes.
std::string npy_header(const Contributions& c) {
    std::string description =
        fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': (2, {}, {}, {}), }}",
                    c.sources.size(),
                    c.replicates,
                    c.points);
    constexpr std::size_t fixed = 10; // magic 6, version 2, length 2
    while ((fixed + description.size() + 1) % 64 != 0)
        description += ' ';
    description += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(description.size() & 0xffU);
    header += static_cast<char>(description.size() >> 8U);
    return header + description;
}

Json to_json(const LightSource& s) {
    return {{"name", s.name},
            {"kind", kind_words[static_cast<std::size_t>(s.kind)]},
            {"flux_lm", s.flux},
            {"luminaires", s.luminaires}};
}

LightSource to_source(const Json& json) {
    LightSource s;
    s.name = json.at("name").get<std::string>();
    const auto word = json.at("kind").get<std::string>();
    const auto kind = std::find(kind_words.begin(), kind_words.end(), word);
    if (kind == kind_words.end())
        throw std::invalid_argument("unknown kind of source '" + word + "'");
    s.kind = static_cast<SourceKind>(kind - kind_words.begin());
    s.flux = json.at("flux_lm").get<double>();
    s.luminaires = json.at("luminaires").get<std::vector<std::size_t>>();
    return s;
}

/// The document without its values, and the hash of the table that holds them.
struct Index {
    ContributionsDocument document;
    std::string table_sha256;
};

Index to_index(const Json& json) {
    if (json.at("isolux_contributions") != 1)
        throw std::invalid_argument("this format is not version 1");
    Index index;
    index.table_sha256 = json.at("sha256").get<std::string>();
    Contributions& c = index.document.contributions;
    for (const Json& s : json.at("sources"))
        c.sources.push_back(to_source(s));
    c.replicates = json.at("replicates").get<std::size_t>();
    for (const Json& s : json.at("surfaces")) {
        index.document.surfaces.push_back({s.at("name").get<std::string>(),
                                           s.at("first_point").get<std::size_t>(),
                                           s.at("points").get<std::size_t>()});
        const SurfacePoints& points = index.document.surfaces.back();
        if (points.first_point != c.points)
            throw std::invalid_argument("the surfaces' points do not follow each other");
        c.points += points.points;
    }
    return index;
}

Index parse_index(const std::string& text, const std::string& source) {
    try {
        return to_index(Json::parse(text));
    } catch (const std::exception& error) {
        throw InputError(source,
                         fmt::format("this is no index of contributions ({})", error.what()),
                         "Run the calculation again?");
    }
}

} // namespace

std::string to_npy(const Contributions& contributions) {
    std::string bytes = npy_header(contributions);
    bytes.reserve(bytes.size()
                  + 4 * (contributions.direct.size() + contributions.indirect.size()));
    append_floats(bytes, contributions.direct);
    append_floats(bytes, contributions.indirect);
    return bytes;
}

std::string to_contributions_json(const ContributionsDocument& document,
                                  std::string_view table_sha256) {
    const Contributions& c = document.contributions;
    Json json{{"isolux_contributions", 1},
              {"table", contributions_table},
              {"sha256", table_sha256},
              {"unit", "lx"},
              {"axes", {"part", "source", "replicate", "point"}},
              {"parts", {"direct", "indirect"}}};
    Json& sources = json["sources"] = Json::array();
    for (const LightSource& s : c.sources)
        sources.push_back(to_json(s));
    json["replicates"] = c.replicates;
    Json& surfaces = json["surfaces"] = Json::array();
    for (const SurfacePoints& s : document.surfaces)
        surfaces.push_back(
            {{"name", s.surface}, {"first_point", s.first_point}, {"points", s.points}});
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_contributions(const std::filesystem::path& folder, const Results& results) {
    ContributionsDocument document;
    std::size_t first = 0;
    for (const SurfaceResult& s : results.surfaces) {
        document.surfaces.push_back({s.surface.name, first, s.points.size()});
        first += s.points.size();
    }
    const std::string table = to_npy(*results.contributions);
    // The values themselves stay where they are; the index needs the rest.
    document.contributions.sources = results.contributions->sources;
    document.contributions.replicates = results.contributions->replicates;
    write_file_safely(folder / contributions_table, table);
    write_file_safely(folder / contributions_index,
                      to_contributions_json(document, sha256(table)));
}

void remove_contributions(const std::filesystem::path& folder) {
    remove_file(folder / contributions_index);
    remove_file(folder / contributions_table);
}

ContributionsDocument read_contributions(const std::filesystem::path& folder) {
    const std::filesystem::path index_path = folder / contributions_index;
    const std::filesystem::path table_path = folder / contributions_table;
    Index index =
        parse_index(read_file_bytes(index_path, FileLimits::results), index_path.string());
    const std::string table = read_file_bytes(table_path, FileLimits::contributions);
    Contributions& c = index.document.contributions;
    const std::string header = npy_header(c);
    const std::size_t values = c.sources.size() * c.replicates * c.points;
    if (sha256(table) != index.table_sha256 || table.compare(0, header.size(), header) != 0
        || table.size() != header.size() + 8 * values)
        throw InputError(table_path.string(),
                         fmt::format("this table does not belong to {} (another calculation's, "
                                     "or changed since)",
                                     contributions_index),
                         "Run the calculation again?");
    const std::string_view numbers = std::string_view(table).substr(header.size());
    c.direct.resize(values);
    c.indirect.resize(values);
    for (std::size_t i = 0; i < values; ++i) {
        c.direct[i] = float_at(numbers, i);
        c.indirect[i] = float_at(numbers, values + i);
    }
    return std::move(index.document);
}

} // namespace isolux
