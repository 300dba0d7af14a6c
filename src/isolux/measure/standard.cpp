#include "isolux/measure/standard.h"

#include <algorithm>

namespace isolux {

namespace {

std::string source_key(const StandardRow& row, const std::string& symbol) {
    for (const auto& [own, key] : row.sources)
        if (own == symbol)
            return key;
    return row.source;
}

std::string source_text(const Standard& standard, const std::string& key) {
    for (const StandardSource& s : standard.sources)
        if (s.key == key)
            return s.text;
    return key;
}

} // namespace

const StandardRow* find_row(const Standard& standard, std::string_view id) noexcept {
    const auto found =
        std::ranges::find_if(standard.rows, [&](const StandardRow& r) { return r.id == id; });
    return found == standard.rows.end() ? nullptr : &*found;
}

std::optional<double> find_limit(const StandardRow& row, std::string_view symbol) noexcept {
    for (const auto& [own, limit] : row.limits)
        if (own == symbol)
            return limit;
    return std::nullopt;
}

std::vector<Requirement>
requirements_of(const Standard& standard, const StandardRow& row, RowLevel level) {
    std::vector<Requirement> requirements;
    for (const StandardColumn& c : standard.columns) {
        const std::string& symbol = c.form.symbol;
        std::optional<double> limit = find_limit(row, symbol);
        std::string key = source_key(row, symbol);
        if (!c.raises.empty())
            continue; // found below, from the column it raises
        if (!limit && c.limit && find_limit(row, c.with)) {
            limit = c.limit;
            key = c.source.empty() ? row.source : c.source;
        }
        if (!limit)
            continue;
        for (const StandardColumn& higher : standard.columns)
            if (level == RowLevel::modified && higher.raises == symbol)
                if (const auto raised = find_limit(row, higher.form.symbol)) {
                    limit = raised;
                    key = source_key(row, higher.form.symbol);
                }
        Requirement r = c.form;
        r.standard = standard.name;
        r.row = row.id;
        r.clause = c.form.clause + "; " + row.clause;
        r.task = row.task;
        r.limit = *limit;
        r.source = source_text(standard, key);
        r.is_recalled = key == "recalled";
        requirements.push_back(std::move(r));
    }
    return requirements;
}

} // namespace isolux
