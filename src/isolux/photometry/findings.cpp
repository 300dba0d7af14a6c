#include "isolux/photometry/findings.h"

#include <utility>

namespace isolux {

std::string Findings::place(std::size_t line) const {
    return source_ + ':' + std::to_string(line);
}

void Findings::note(std::size_t line, std::string what, std::string hint) {
    if (notices_.size() < most_notices)
        notices_.push_back({place(line), std::move(what), std::move(hint)});
    else if (notices_.size() == most_notices)
        notices_.push_back({place(line), "more notices follow (left out)", {}});
}

void Findings::warn(std::size_t line, std::string what, std::string hint) {
    note(line, std::move(what), std::move(hint));
    if (warnings_.size() < most_notices)
        warnings_.push_back(notices_.back());
}

void Findings::add(const Findings& inner) {
    for (const auto& [from, to] :
         {std::pair{&inner.notices_, &notices_}, std::pair{&inner.warnings_, &warnings_}})
        for (const Message& m : *from)
            if (to->size() <= most_notices)
                to->push_back(m);
}

void Findings::fail(std::size_t line, std::string what, std::string hint) const {
    throw InputError(place(line), std::move(what), std::move(hint));
}

void Findings::refuse_warnings() const {
    if (!warnings_.empty())
        throw InputError(warnings_);
}

} // namespace isolux
