#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "isolux/calc/judge.h"
#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"

namespace isolux::report {

namespace {

Mark mark_of(Decision d) {
    switch (d) {
    case Decision::pass:
        return Mark::pass;
    case Decision::fail:
        return Mark::fail;
    case Decision::undecided:
        return Mark::undecided;
    case Decision::not_judged:
        break;
    }
    return Mark::not_judged;
}

const std::string& word_of(Decision d, const Texts& t) {
    switch (d) {
    case Decision::pass:
        return t.pass;
    case Decision::fail:
        return t.fail;
    case Decision::undecided:
        return t.undecided;
    case Decision::not_judged:
        break;
    }
    return t.not_judged;
}

const std::string& sentence_of(Decision d, const Texts& t) {
    switch (d) {
    case Decision::pass:
        return t.all_pass;
    case Decision::fail:
        return t.one_fails;
    case Decision::undecided:
        return t.one_undecided;
    case Decision::not_judged:
        break;
    }
    return t.none_judged;
}

/// "≥ 500 lx", "≤ 19".
std::string limit_of(const Requirement& r) {
    return fmt::format("{} {:g}{}{}",
                       r.sense == Sense::at_least ? "≥" : "≤",
                       r.limit,
                       r.unit.empty() || r.unit == "1" ? "" : " ",
                       r.unit == "1" ? "" : r.unit);
}

std::vector<Cell> row_of(const Verdict& v, const Texts& t) {
    const Requirement& r = v.requirement;
    std::string name = r.symbol;
    if (r.is_recommendation)
        name += " (" + t.recommended + ")";
    std::vector<Cell> row{
        {v.subject}, {name}, {fmt::format("{} {}", r.standard, r.row)}, {limit_of(r), r.limit}};
    if (v.decision == Decision::not_judged)
        row.insert(row.end(), 4, Cell{"–"});
    else
        row.insert(row.end(),
                   {number_cell(v.value.mean),
                    number_cell(v.interval.lower),
                    number_cell(v.interval.upper),
                    number_cell(v.margin)});
    row.push_back({word_of(v.decision, t), std::nullopt, mark_of(v.decision)});
    return row;
}

/// The place of `text` in `list`, counted from 1; it is added where it is new.
std::size_t number_in(std::vector<std::string>& list, std::string text) {
    const auto at = std::find(list.begin(), list.end(), text);
    const auto number = static_cast<std::size_t>(at - list.begin()) + 1;
    if (at == list.end())
        list.push_back(std::move(text));
    return number;
}

/// What stands behind the requirements: words, clause, number of the source below the table.
void add_sources(Section& section, const std::vector<Verdict>& verdicts, const Texts& t) {
    Table table{t.source_caption, {{t.requirement}, {t.task}, {t.clause}, {t.source}}, {}};
    std::vector<std::string> sources;
    for (const Verdict& v : verdicts) {
        const Requirement& r = v.requirement;
        const std::size_t number =
            number_in(sources, r.is_recalled ? r.source + " " + t.recalled : r.source);
        std::vector<Cell> row{{fmt::format("{} {} {}", r.symbol, limit_of(r), r.row)},
                              {r.name + (r.task.empty() ? "" : "; " + r.task)},
                              {r.standard + (r.clause.empty() ? "" : ", " + r.clause)},
                              {fmt::format("({})", number)}};
        const auto is_same = [&](const std::vector<Cell>& known) {
            return std::equal(row.begin(),
                              row.end(),
                              known.begin(),
                              [](const Cell& a, const Cell& b) { return a.text == b.text; });
        };
        if (std::none_of(table.rows.begin(), table.rows.end(), is_same))
            table.rows.push_back(std::move(row));
    }
    section.blocks.emplace_back(std::move(table));
    for (std::size_t k = 0; k < sources.size(); ++k)
        section.blocks.emplace_back(
            Paragraph{fmt::format("({}) {}", k + 1, sources[k]), Mark::none, true});
}

} // namespace

Table make_verdict_table(const std::vector<Verdict>& verdicts,
                         std::string caption,
                         const Texts& t) {
    Table table{std::move(caption),
                {{t.place},
                 {t.requirement},
                 {t.standard},
                 {t.limit, true},
                 {t.value, true},
                 {t.lower, true},
                 {t.upper, true},
                 {t.margin, true},
                 {t.verdict}},
                {}};
    for (const Verdict& v : verdicts)
        table.rows.push_back(row_of(v, t));
    return table;
}

Section make_verdict_section(const ResultsDocument& d, const Texts& t) {
    const std::vector<Verdict>& verdicts = d.results.verdicts;
    Section section{"verdict", t.verdict_title, {}};
    const Decision all = overall(verdicts);
    section.blocks.emplace_back(
        Paragraph{fmt::format("{}: {}", word_of(all, t), sentence_of(all, t)), mark_of(all)});
    section.blocks.emplace_back(Paragraph{fill(t.verdict_intro, {to_percent(d.confidence)})});
    section.blocks.emplace_back(make_verdict_table(verdicts, t.verdict_caption, t));
    std::vector<std::string> notes; // two rows of a standard may have the same one
    for (const Verdict& v : verdicts)
        if (!v.reason.empty())
            number_in(notes, fill(t.verdict_note, {v.subject, v.requirement.symbol, v.reason}));
    for (std::string& note : notes)
        section.blocks.emplace_back(Paragraph{std::move(note), Mark::none, true});
    add_sources(section, verdicts, t);
    return section;
}

} // namespace isolux::report
