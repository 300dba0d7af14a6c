#include "isolux/io/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <string>

#include "isolux/measure/quantity.h"

namespace isolux {

namespace {

std::string to_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos)
        return std::string(text);
    std::string field = "\"";
    for (const char c : text) {
        if (c == '"')
            field += '"';
        field += c;
    }
    return field + '"';
}

void append_row(std::string& csv, std::initializer_list<std::string_view> fields) {
    bool is_first = true;
    for (const std::string_view field : fields) {
        if (!is_first)
            csv += ',';
        csv += to_field(field);
        is_first = false;
    }
    csv += "\r\n";
}

std::string value_column(IlluminanceKind kind) {
    std::string name(quantity_name(kind));
    std::ranges::replace_if(
        name, [](char c) { return c == ' ' || c == '-'; }, '_');
    return name + "_lx";
}

std::string flag_words(const PointResult& p) {
    std::string words;
    const auto add = [&](bool is_raised, std::string_view word) {
        if (is_raised)
            words.append(words.empty() ? "" : " ").append(word);
    };
    add(p.suspicious_replicate, "suspicious_replicate");
    add(p.heavy_tail, "heavy_tail");
    add(p.near_surface, "near_surface");
    return words;
}

void append_summary(std::string& csv,
                    const std::string& surface,
                    std::string_view quantity,
                    std::string_view unit,
                    const Estimate& e,
                    double confidence) {
    const Interval interval = confidence_interval(e, confidence);
    append_row(csv,
               {surface,
                quantity,
                unit,
                to_shortest(e.mean),
                to_shortest(e.standard_error),
                to_shortest(interval.lower),
                to_shortest(interval.upper),
                std::to_string(e.samples)});
}

/// Reads one record after another.
class CsvParser {
public:
    CsvParser(std::string_view text, std::string_view source) : text_(text), source_(source) {}

    [[nodiscard]] bool is_at_end() const noexcept { return at_ == text_.size(); }

    CsvRecord record() {
        CsvRecord r{line_, {field()}};
        while (!is_at_end() && text_[at_] == ',') {
            ++at_;
            r.fields.push_back(field());
        }
        end_of_line();
        return r;
    }

private:
    std::string field() {
        if (!is_at_end() && text_[at_] == '"')
            return quoted();
        const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
        const std::string_view plain = text_.substr(at_, end - at_);
        at_ = end;
        return std::string(plain);
    }

    std::string quoted() {
        const int opened = line_;
        std::string value;
        for (++at_; !is_at_end(); ++at_) {
            if (text_[at_] == '"' && !text_.substr(at_).starts_with("\"\"")) {
                ++at_;
                if (!is_at_end() && text_.find_first_of(",\r\n", at_) != at_)
                    fail(line_, "text after a closing quote", "Double the quotes inside?");
                return value;
            }
            if (text_[at_] == '"')
                ++at_;
            if (text_[at_] == '\n')
                ++line_;
            value += text_[at_];
        }
        fail(opened, "a quote is opened here and never closed", "Truncated file?");
    }

    void end_of_line() {
        if (!is_at_end() && text_[at_] == '\r')
            ++at_;
        if (!is_at_end() && text_[at_] == '\n') {
            ++at_;
            ++line_;
        }
    }

    [[noreturn]] void fail(int line, const char* what, const char* hint) const {
        throw InputError(std::string(source_) + ":" + std::to_string(line), what, hint);
    }

    std::string_view text_;
    std::string_view source_;
    std::size_t at_ = 0;
    int line_ = 1;
};

} // namespace

std::string to_shortest(double value) {
    std::array<char, 32> digits{};
    const auto [end, error] =
        std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), end};
}

std::string to_csv(const SurfaceResult& result, double confidence) {
    std::string csv;
    append_row(csv,
               {"x_m",
                "y_m",
                "z_m",
                "nx",
                "ny",
                "nz",
                value_column(result.surface.kind),
                "standard_error_lx",
                "lower_lx",
                "upper_lx",
                "direct_lx",
                "indirect_lx",
                "flags"});
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        const Receiver& r = result.surface.receivers[i];
        const PointResult& p = result.points[i];
        const Interval interval = confidence_interval(p.total, confidence);
        append_row(csv,
                   {to_shortest(r.point.x),
                    to_shortest(r.point.y),
                    to_shortest(r.point.z),
                    to_shortest(r.axis.x()),
                    to_shortest(r.axis.y()),
                    to_shortest(r.axis.z()),
                    to_shortest(p.total.mean),
                    to_shortest(p.total.standard_error),
                    to_shortest(interval.lower),
                    to_shortest(interval.upper),
                    to_shortest(p.direct.mean),
                    to_shortest(p.indirect.mean),
                    flag_words(p)});
    }
    return csv;
}

std::string to_sensitivities_csv(const Results& results) {
    std::string csv = "surface,point,x_m,y_m,z_m,material,reflectance,derivative_lx,"
                      "standard_error_lx\r\n";
    const Sensitivities& s = *results.sensitivities;
    std::size_t first = 0;
    for (const SurfaceResult& surface : results.surfaces) {
        const std::size_t points = surface.points.size();
        for (std::size_t m = 0; m < s.materials.size() && points > 0; ++m) {
            const auto append = [&](const std::string& point,
                                    const std::array<std::string, 3>& place,
                                    const Estimate& e) {
                append_row(csv,
                           {surface.surface.name,
                            point,
                            place[0],
                            place[1],
                            place[2],
                            s.materials[m].name,
                            to_shortest(s.materials[m].reflectance),
                            to_shortest(e.mean),
                            to_shortest(e.standard_error)});
            };
            append("mean", {}, s.of_mean(m, first, points));
            for (std::size_t p = 0; p < points; ++p) {
                const Point3& at = surface.surface.receivers[p].point;
                append(std::to_string(p + 1),
                       {to_shortest(at.x), to_shortest(at.y), to_shortest(at.z)},
                       s.at(m, first + p));
            }
        }
        first += points;
    }
    return csv;
}

std::string to_summary_csv(const Results& results) {
    std::string csv;
    append_row(csv,
               {"surface",
                "quantity",
                "unit",
                "value",
                "standard_error",
                "lower",
                "upper",
                "replicates"});
    for (const SurfaceResult& s : results.surfaces) {
        const auto add = [&](std::string_view name, std::string_view unit, const Estimate& e) {
            append_summary(csv, s.surface.name, name, unit, e, results.confidence);
        };
        add("mean", "lx", s.summary.mean);
        add("minimum", "lx", s.summary.minimum);
        add("maximum", "lx", s.summary.maximum);
        add("U0", "1", s.summary.uniformity);
        add("Ud", "1", s.summary.diversity);
    }
    return csv;
}

std::vector<CsvRecord> parse_csv(std::string_view text, std::string_view source) {
    std::vector<CsvRecord> records;
    CsvParser parser(text, source);
    while (!parser.is_at_end()) {
        CsvRecord r = parser.record();
        if (r.fields.size() > 1 || !r.fields.front().empty())
            records.push_back(std::move(r));
    }
    return records;
}

} // namespace isolux
