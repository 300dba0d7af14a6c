#include "isolux/base/error.h"

#include <utility>

namespace isolux {

namespace {

std::string join(const std::vector<Message>& messages) {
    std::string text;
    for (const Message& m : messages) {
        if (!text.empty())
            text += '\n';
        text += to_string(m);
    }
    return text;
}

} // namespace

std::string to_string(const Message& message) {
    std::string text =
        message.where.empty() ? message.what : message.where + ": " + message.what;
    if (!message.hint.empty())
        text += ". " + message.hint;
    return text;
}

InputError::InputError(std::string where, std::string what, std::string hint)
    : InputError(std::vector<Message>{{std::move(where), std::move(what), std::move(hint)}}) {}

InputError::InputError(std::vector<Message> messages)
    : std::runtime_error(join(messages)), messages_(std::move(messages)) {}

} // namespace isolux
