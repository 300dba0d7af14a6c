#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace isolux {

/// A value that fits on one line: no members but plain values and lists of plain values.
template <class Json> bool is_one_line(const Json& json) {
    return std::ranges::all_of(json, [](const Json& member) {
        return member.is_primitive()
               || (member.is_array() && std::ranges::all_of(member, [](const Json& m) {
                       return m.is_primitive();
                   }));
    });
}

/// JSON text, written member by member: as a tree of values the points of a large project would
/// take several times the memory of their text. `Json` is any nlohmann::basic_json; this header
/// needs none.
class JsonText {
public:
    void begin(char bracket) {
        text_ += bracket;
        ++depth_;
        is_first_ = true;
    }

    void end(char bracket) {
        --depth_;
        if (!is_first_)
            new_line();
        text_ += bracket;
        is_first_ = false;
    }

    /// Begins an item of a list.
    void item() {
        if (!is_first_)
            text_ += ',';
        new_line();
        is_first_ = false;
    }

    /// Begins a member of an object.
    template <class Json> void key(const Json& name) {
        item();
        text_ += dump(name) + ": ";
    }

    template <class Json> void value(const Json& json) {
        if (json.is_primitive() || is_one_line(json)) {
            text_ += dump(json);
        } else if (json.is_object()) {
            begin('{');
            members(json);
            end('}');
        } else {
            begin('[');
            for (const Json& element : json) {
                item();
                value(element);
            }
            end(']');
        }
    }

    template <class Json> void members(const Json& object) {
        for (const auto& [name, member] : object.items()) {
            key(Json(name));
            value(member);
        }
    }

    /// A member that is a list. @param name  a string of JSON  @param write_item  writes the
    /// value of an item, by its number
    template <class Json, class WriteItem>
    void list(const Json& name, std::size_t items, const WriteItem& write_item) {
        key(name);
        begin('[');
        for (std::size_t i = 0; i < items; ++i) {
            item();
            write_item(i);
        }
        end(']');
    }

    [[nodiscard]] std::string finish() && {
        text_ += '\n';
        return std::move(text_);
    }

private:
    /// Names the user gave may hold any bytes; what is no UTF-8 becomes U+FFFD.
    template <class Json> static std::string dump(const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    void new_line() {
        text_ += '\n';
        text_.append(depth_, ' ');
    }

    std::string text_;
    std::size_t depth_ = 0;
    bool is_first_ = true; ///< nothing is written yet inside the innermost bracket
};

} // namespace isolux
