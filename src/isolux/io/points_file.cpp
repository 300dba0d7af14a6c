#include "isolux/io/points_file.h"

#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace isolux {

namespace {

bool is_separator(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r' || c == '\f';
}

/// The words of a line, up to a comment.
std::vector<std::string_view> split_words(std::string_view line) {
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> words;
    std::size_t i = 0;
    while (i < line.size()) {
        while (i < line.size() && is_separator(line[i]))
            ++i;
        const std::size_t start = i;
        while (i < line.size() && !is_separator(line[i]))
            ++i;
        if (i > start)
            words.push_back(line.substr(start, i - start));
    }
    return words;
}

} // namespace

std::variant<DirectedPoint, NoPoint, Message> parse_point_line(std::string_view line) {
    constexpr double largest = 1e6; // m, as in the project file
    const std::vector<std::string_view> words = split_words(line);
    if (words.empty())
        return NoPoint{};
    if (words.size() != 3 && words.size() != 6)
        return Message{{},
                       fmt::format("{} number{} (a point is x y z or x y z nx ny nz)",
                                   words.size(),
                                   words.size() == 1 ? "" : "s"),
                       {}};
    std::array<double, 6> v{0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string_view word = words[i];
        if (word.size() > 1 && word.front() == '+')
            word.remove_prefix(1);
        const char* end = word.data() + word.size();
        const auto [rest, failed] = std::from_chars(word.data(), end, v[i]);
        if (failed != std::errc() || rest != end || !std::isfinite(v[i]))
            return Message{
                {},
                fmt::format("\"{}\" is not a number (a point is x y z or x y z nx ny nz)",
                            words[i].substr(0, 40)),
                {}};
        if (std::abs(v[i]) > largest)
            return Message{{}, fmt::format("{} m is too far away (at most 1000 km)", v[i]), {}};
    }
    const Vector3 normal{v[3], v[4], v[5]};
    if (length(normal) == 0.0)
        return Message{{}, "the normal has no length (which way does the point face?)", {}};
    return DirectedPoint{{v[0], v[1], v[2]}, UnitVector3(normal)};
}

std::vector<DirectedPoint> parse_points(std::string_view text, std::string_view source) {
    constexpr std::size_t most_messages = 100;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.substr(0, byte_order_mark.size()) == byte_order_mark)
        text.remove_prefix(byte_order_mark.size());
    std::vector<DirectedPoint> points;
    std::vector<Message> messages;
    std::size_t number = 0;
    while (!text.empty() && messages.size() < most_messages) {
        const std::size_t end = text.find('\n');
        auto parsed = parse_point_line(text.substr(0, end));
        ++number;
        if (const auto* point = std::get_if<DirectedPoint>(&parsed)) {
            points.push_back(*point);
        } else if (auto* message = std::get_if<Message>(&parsed)) {
            message->where = fmt::format("{}:{}", source, number);
            messages.push_back(std::move(*message));
        }
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    if (messages.empty() && points.empty())
        messages.push_back(
            {std::string(source), "no point in the file (nothing to measure)", {}});
    if (!messages.empty())
        throw InputError(std::move(messages));
    return points;
}

} // namespace isolux
