#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace isolux {

/// One thing to tell the user: `place: problem (why it is one). Suggestion?`
/// The place is `file:line:column` for text and `file:line: #/json/pointer` for meaning.
struct Message {
    std::string where;
    std::string what;
    std::string hint; ///< may be empty

    friend bool operator==(const Message&, const Message&) = default;
};

[[nodiscard]] std::string to_string(const Message& message);

/// The user's input is wrong. Carries every problem found, not only the first. `main` prints
/// them and exits with 2.
class InputError : public std::runtime_error {
public:
    InputError(std::string where, std::string what, std::string hint = {});
    explicit InputError(std::vector<Message> messages);

    [[nodiscard]] const std::vector<Message>& messages() const noexcept { return messages_; }

private:
    std::vector<Message> messages_;
};

/// The ray tracing device, a display or another part of the outside world failed.
class DeviceError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Input that is odd but usable: the value, and what was assumed on the way.
template <class T> struct Parsed {
    T value;
    std::vector<Message> notices;
};

} // namespace isolux
