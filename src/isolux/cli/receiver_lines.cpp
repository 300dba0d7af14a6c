#include "isolux/cli/receiver_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <utility>

#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/cli/parse_values.h"

namespace isolux {

namespace {

/// The words of the messages.
struct FormWords {
    const char* line;
    const char* zero;
    const char* remedy;
};

FormWords words_of(LineForm form) {
    if (form == LineForm::sight_line)
        return {"A line is x y z dx dy dz, in metres",
                "the direction is zero (it points nowhere)",
                "0 0 -1 looks down"};
    return {"A line is x y z nx ny nz, in metres",
            "the normal is zero (it has no direction)",
            "0 0 1 faces upwards"};
}

constexpr std::size_t longest_line = 4096; ///< bytes; six numbers take far less
constexpr std::size_t most_messages = 10;

std::vector<std::string_view> split(std::string_view text) {
    constexpr std::string_view separators = " \t\r,;";
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t first = text.find_first_not_of(separators);
        if (first == std::string_view::npos)
            return words;
        text.remove_prefix(first);
        const std::size_t length = std::min(text.find_first_of(separators), text.size());
        words.push_back(text.substr(0, length));
        text.remove_prefix(length);
    }
}

/// Reads a line without trusting its length. False at the end of the input.
bool read_line(std::istream& in, std::string& line) {
    line.clear();
    for (int c = in.get(); c != std::istream::traits_type::eof(); c = in.get()) {
        if (c == '\n')
            return true;
        if (line.size() <= longest_line)
            line.push_back(static_cast<char>(c));
    }
    return !line.empty();
}

} // namespace

std::optional<Receiver>
parse_receiver(std::string_view text, const std::string& where, LineForm form) {
    const FormWords say = words_of(form);
    if (text.size() > longest_line)
        throw InputError(where, fmt::format("more than {} characters", longest_line), say.line);
    const std::vector<std::string_view> words = split(text.substr(0, text.find('#')));
    if (words.empty())
        return std::nullopt;
    std::array<double, 6> numbers{};
    for (std::size_t i = 0; i < words.size() && i < numbers.size(); ++i) {
        numbers[i] = parse_finite_number(words[i]);
        if (std::isnan(numbers[i]))
            throw InputError(
                where, fmt::format("'{:.40}' is not a number", words[i]), say.line);
    }
    if (words.size() != numbers.size())
        throw InputError(
            where, fmt::format("{} numbers in place of 6", words.size()), say.line);
    const Vector3 normal{numbers[3], numbers[4], numbers[5]};
    if (normal == Vector3{})
        throw InputError(where, say.zero, say.remedy);
    // Scaled before it is normalised: the square of a huge or tiny number is no number.
    const double scale = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    return Receiver{{numbers[0], numbers[1], numbers[2]}, UnitVector3(normal / scale), {}, {}};
}

std::vector<Receiver> ReceiverLines::read(std::size_t count) {
    std::vector<Receiver> receivers;
    std::vector<Message> messages;
    std::string line;
    while (receivers.size() < count && read_line(in_, line)) {
        ++line_;
        try {
            if (auto receiver =
                    parse_receiver(line, fmt::format("{}:{}", source_, line_), form_))
                receivers.push_back(*receiver);
        } catch (const InputError& e) {
            messages.push_back(e.messages().front());
            if (messages.size() == most_messages)
                break;
        }
    }
    if (!messages.empty())
        throw InputError(std::move(messages));
    return receivers;
}

} // namespace isolux
