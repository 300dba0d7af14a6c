#include "isolux/report/page_writer.h"

#include <utility>

#include <fmt/format.h>

namespace isolux::report {

void PageWriter::begin_section(const std::string& title) {
    section_ = title;
    new_page();
    page().title = title;
}

void PageWriter::join_section(const std::string& title, double needed) {
    if (left_over() < needed || is_at_top()) {
        begin_section(title);
        return;
    }
    section_ = title;
    page().title += ", " + title; // a page has one bookmark
    skip(5.0);
}

void PageWriter::new_page() {
    if (!pages_.empty() && is_at_top())
        return;
    pages_.push_back({width, height, section_, {}});
    y_ = top;
}

void PageWriter::reserve(double needed) {
    if (needed > left_over())
        new_page();
}

Drawing& PageWriter::page() {
    if (pages_.empty())
        pages_.push_back({width, height, section_, {}});
    return pages_.back();
}

void PageWriter::write(const std::string& text, double size, Weight weight, Colour colour) {
    for (std::string& line : wrap(text, text_width, size, weight)) {
        reserve(line_space * size);
        add(make_text(std::move(line), {left, y_ + size}, size, Anchor::start, weight, colour));
        y_ += line_space * size;
    }
}

std::vector<std::string>
PageWriter::wrap(const std::string& text, double line_width, double size, Weight weight) const {
    const auto fits = [&](const std::string& line) {
        return ruler_.width(line, size, weight) <= line_width;
    };
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        std::string word = text.substr(at, end - at);
        at = end + 1;
        if (std::string longer = line.empty() ? word : line + ' ' + word; fits(longer)) {
            line = std::move(longer);
            continue;
        }
        if (!line.empty())
            lines.push_back(std::exchange(line, {}));
        while (!fits(word)) { // cut between characters, not inside one
            std::size_t cut = 0;
            for (std::size_t next = 1; next <= word.size(); ++next) {
                if (next < word.size()
                    && (static_cast<unsigned char>(word[next]) & 0xC0) == 0x80)
                    continue;
                if (cut > 0 && !fits(word.substr(0, next)))
                    break;
                cut = next;
            }
            lines.push_back(word.substr(0, cut));
            word.erase(0, cut);
        }
        line = std::move(word);
    }
    if (!line.empty() || lines.empty())
        lines.push_back(std::move(line));
    return lines;
}

std::vector<Drawing> PageWriter::finish(const std::string& footer) && {
    constexpr double size = 2.4;
    const double y = height - 12.0;
    for (std::size_t k = 0; k < pages_.size(); ++k) {
        auto& items = pages_[k].items;
        items.emplace_back(
            make_line({{left, y - 4.0}, {left + text_width, y - 4.0}}, {ink::light_grey, 0.2}));
        const std::string number = fmt::format("{} / {}", k + 1, pages_.size());
        const double room = text_width - ruler_.width(number, size, Weight::normal) - 5.0;
        items.emplace_back(make_text(shorten(footer, room, size, Weight::normal, ruler_),
                                     {left, y},
                                     size,
                                     Anchor::start,
                                     Weight::normal,
                                     ink::grey));
        items.emplace_back(make_text(
            number, {left + text_width, y}, size, Anchor::end, Weight::normal, ink::grey));
    }
    return std::move(pages_);
}

MarkInk ink_of(Mark mark) {
    switch (mark) {
    case Mark::pass:
        return {{13, 74, 28}, {223, 242, 226}, {46, 125, 60}};
    case Mark::fail:
        return {{138, 19, 19}, {253, 228, 225}, {179, 38, 30}};
    case Mark::undecided:
        return {{51, 51, 51}, {230, 230, 230}, {119, 119, 119}};
    default:
        return {{51, 51, 51}, ink::white, {153, 153, 153}};
    }
}

} // namespace isolux::report
