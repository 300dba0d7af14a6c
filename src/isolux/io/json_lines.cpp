#include "isolux/io/json_lines.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "isolux/io/json_node.h"

namespace isolux {

namespace {

/// Appends a code point as UTF-8.
void append_utf8(std::string& text, unsigned code) {
    const auto byte = [&](unsigned value) { text += static_cast<char>(value); };
    if (code < 0x80) {
        byte(code);
        return;
    }
    if (code < 0x800) {
        byte(0xc0 | (code >> 6));
    } else {
        if (code < 0x10000) {
            byte(0xe0 | (code >> 12));
        } else {
            byte(0xf0 | (code >> 18));
            byte(0x80 | ((code >> 12) & 0x3f));
        }
        byte(0x80 | ((code >> 6) & 0x3f));
    }
    byte(0x80 | (code & 0x3f));
}

/// Walks through the text once and notes the lines of the pointers it was asked for.
class LineScanner {
public:
    LineScanner(std::string_view text, std::map<std::string, std::size_t>& lines)
        : text_(text), lines_(lines) {}

    void scan() {
        if (text_.starts_with("\xEF\xBB\xBF")) // a byte order mark
            at_ = 3;
        skip_blanks();
        note("", line_);
        scan_value("");
    }

private:
    [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    [[nodiscard]] char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }

    [[nodiscard]] bool is_at_end() const { return at_ >= text_.size(); }

    void step() {
        if (here() == '\n')
            ++line_;
        ++at_;
    }

    void note(const std::string& pointer, std::size_t line) {
        if (const auto wanted = lines_.find(pointer); wanted != lines_.end())
            wanted->second = line;
    }

    void skip_blanks() {
        while (!is_at_end()) {
            if (here() == '/' && next() == '/') {
                while (!is_at_end() && here() != '\n')
                    step();
            } else if (here() == '/' && next() == '*') {
                step();
                step();
                while (!is_at_end() && !(here() == '*' && next() == '/'))
                    step();
                step();
                step();
            } else if (here() == ' ' || here() == '\t' || here() == '\r' || here() == '\n') {
                step();
            } else {
                return;
            }
        }
    }

    /// Steps over a text in quotes. @return what it says
    std::string scan_text() {
        std::string said;
        step();
        while (!is_at_end() && here() != '"') {
            if (here() == '\\') {
                step();
                scan_escape(said);
            } else {
                said += here();
                step();
            }
        }
        step();
        return said;
    }

    /// What follows a backslash.
    void scan_escape(std::string& said) {
        const char c = here();
        step();
        switch (c) {
        case 'b':
        case 'f':
        case 'n':
        case 'r':
        case 't':
            said += ' '; // as pointers show control characters
            return;
        case 'u':
            break;
        default:
            said += c;
            return;
        }
        unsigned code = scan_hexadecimal();
        if (code >= 0xd800 && code < 0xdc00 && here() == '\\' && next() == 'u') {
            step();
            step();
            code = 0x10000 + ((code - 0xd800) << 10) + ((scan_hexadecimal() - 0xdc00) & 0x3ff);
        }
        append_utf8(said, code);
    }

    unsigned scan_hexadecimal() {
        unsigned code = 0;
        for (int i = 0; i < 4 && !is_at_end(); ++i) {
            const char c = here();
            code = 16 * code
                   + static_cast<unsigned>(c >= '0' && c <= '9'   ? c - '0'
                                           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                                  : 0);
            step();
        }
        return code;
    }

    void scan_value(const std::string& pointer) {
        if (here() == '{') {
            scan_object(pointer);
        } else if (here() == '[') {
            scan_array(pointer);
        } else if (here() == '"') {
            scan_text();
        } else {
            constexpr std::string_view ends = ",]} \t\r\n/";
            while (!is_at_end() && ends.find(here()) == std::string_view::npos)
                step();
        }
    }

    void scan_object(const std::string& pointer) {
        step();
        for (skip_blanks(); here() == '"'; skip_blanks()) {
            const std::size_t line = line_;
            const std::string member = pointer + pointer_step(scan_text());
            note(member, line);
            skip_blanks();
            if (here() != ':')
                return;
            step();
            skip_blanks();
            scan_value(member);
            skip_blanks();
            if (here() != ',')
                break;
            step();
        }
        step();
    }

    void scan_array(const std::string& pointer) {
        step();
        skip_blanks();
        for (std::size_t i = 0; !is_at_end() && here() != ']'; ++i) {
            const std::string item = fmt::format("{}/{}", pointer, i);
            note(item, line_);
            scan_value(item);
            skip_blanks();
            if (here() != ',')
                break;
            step();
            skip_blanks();
        }
        step();
    }

    std::string_view text_;
    std::map<std::string, std::size_t>& lines_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

} // namespace

std::vector<std::size_t> find_lines(std::string_view text,
                                    std::span<const std::string> pointers) {
    std::map<std::string, std::size_t> lines; // 0: not there
    for (const std::string& pointer : pointers)
        for (std::string above = pointer;; above.resize(above.rfind('/'))) {
            lines.emplace(above, 0);
            if (above.find('/') == std::string::npos)
                break;
        }
    LineScanner(text, lines).scan();
    std::vector<std::size_t> found;
    for (std::string at : pointers) {
        while (lines.at(at) == 0 && at.find('/') != std::string::npos)
            at.resize(at.rfind('/'));
        found.push_back(std::max<std::size_t>(1, lines.at(at)));
    }
    return found;
}

void add_lines(std::vector<Message>& messages, const std::string& file, std::string_view text) {
    const std::string start = file + "#";
    std::vector<Message*> meant;
    std::vector<std::string> pointers;
    for (Message& message : messages)
        if (message.where.starts_with(start)) {
            meant.push_back(&message);
            pointers.push_back(message.where.substr(start.size()));
        }
    if (meant.empty())
        return;
    const std::vector<std::size_t> lines = find_lines(text, pointers);
    for (std::size_t i = 0; i < meant.size(); ++i)
        meant[i]->where = fmt::format(
            "{}:{}{}{}", file, lines[i], pointers[i].empty() ? "" : ": #", pointers[i]);
}

} // namespace isolux
