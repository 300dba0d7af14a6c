#include "isolux/io/xlsx.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "isolux/calc/judge.h"
#include "isolux/io/safe_file.h"
#include "isolux/io/text_file.h"
#include "isolux/io/workbook.h"
#include "isolux/measure/quantity.h"

namespace isolux {

namespace {

constexpr std::size_t longest_sheet_name = 31;

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

std::string allowed(std::string name) {
    std::ranges::replace_if(
        name,
        [](char c) {
            return std::string_view("[]:*?/\\").find(c) != std::string_view::npos
                   || static_cast<unsigned char>(c) < 0x20U;
        },
        '_');
    if (!name.empty() && name.front() == '\'')
        name.front() = '_';
    name = cut_text(name, longest_sheet_name);
    if (!name.empty() && name.back() == '\'')
        name.back() = '_';
    return name.empty() ? "sheet" : name;
}

void add_summary(Workbook& book, const Results& r) {
    Sheet s(book,
            "Summary",
            {{"Surface", 28},
             {"Quantity", 24},
             {"Statistic", 12},
             {"Unit", 6},
             {"Value", 11},
             {"Standard error", 11},
             {"Lower end", 11},
             {"Upper end", 11},
             {"Points", 8},
             {"Converged", 11}});
    for (const SurfaceResult& surface : r.surfaces) {
        const SurfaceSummary& m = surface.summary;
        const auto add = [&](const char* name, const char* unit, const Estimate& e) {
            s.text(surface.surface.name)
                .text(std::string(quantity_name(surface.surface.kind)))
                .text(name)
                .text(unit)
                .estimate(e, r.confidence)
                .plain(static_cast<double>(surface.points.size()), 0)
                .text(surface.converged ? "yes" : "no");
            s.next_row();
        };
        add("Em", "lx", m.mean);
        add("Emin", "lx", m.minimum);
        add("Emax", "lx", m.maximum);
        add("U0", "1", m.uniformity);
        add("Ud", "1", m.diversity);
    }
    for (const ModellingResult& m : r.modelling) {
        s.text(r.surfaces[m.cylindrical].surface.name)
            .text("modelling Ez/Eh")
            .text("mean")
            .text("1")
            .estimate(m.mean, r.confidence)
            .plain(static_cast<double>(m.points.size()), 0);
        s.next_row();
    }
}

void add_verdicts(Workbook& book, const Results& r) {
    if (r.verdicts.empty())
        return;
    Sheet s(book,
            "Verdicts",
            {{"Verdict", 12},
             {"Standard", 18},
             {"Row", 8},
             {"Clause", 26},
             {"Task", 34},
             {"Symbol", 12},
             {"Where", 28},
             {"Value", 11},
             {"Lower end", 11},
             {"Upper end", 11},
             {"Sense", 9},
             {"Limit", 9},
             {"Unit", 6},
             {"Margin", 10},
             {"Least margin", 10},
             {"Recommendation", 10},
             {"Source of the limit", 40},
             {"Remark", 40}});
    for (const Verdict& v : r.verdicts) {
        const Requirement& q = v.requirement;
        s.text(std::string(to_word(v.decision)), book.verdict(v.decision))
            .text(q.standard)
            .text(q.row)
            .text(q.clause)
            .text(q.task)
            .text(q.symbol)
            .text(v.subject);
        const double error = v.value.standard_error;
        if (v.decision == Decision::not_judged)
            s.skip().skip().skip();
        else
            s.number(v.value.mean, error)
                .number(v.interval.lower, error)
                .number(v.interval.upper, error);
        s.text(std::string(to_word(q.sense)))
            .plain(q.limit, q.limit < 10.0 ? 2 : 0)
            .text(q.unit);
        if (v.decision == Decision::not_judged)
            s.skip().skip();
        else
            s.number(v.margin, error).number(v.least_margin, error);
        s.text(q.is_recommendation ? "yes" : "").text(q.source).text(v.reason);
        s.next_row();
    }
}

void add_observers(Workbook& book, const Results& r) {
    if (r.observers.empty())
        return;
    Sheet s(book,
            "Observers",
            {{"Group", 24},
             {"Rating", 8},
             {"x [m]", 9},
             {"y [m]", 9},
             {"z [m]", 9},
             {"Looks along x", 9},
             {"Looks along y", 9},
             {"Looks along z", 9},
             {"Value", 10},
             {"Standard error", 10},
             {"Lower end", 10},
             {"Upper end", 10},
             {"Background [cd/m2]", 12},
             {"Luminaires in sight", 11},
             {"Worst of the group", 10},
             {"Remark", 40}});
    for (const ObserverGroupResult& o : r.observers)
        for (std::size_t i = 0; i < o.ratings.size(); ++i) {
            const SightLine& line = o.group.sight_lines[i];
            const GlareRating& g = o.ratings[i];
            s.text(o.group.name)
                .text(o.group.scale == GlareScale::unified ? "UGR" : "GR")
                .plain(line.eye.x, 3)
                .plain(line.eye.y, 3)
                .plain(line.eye.z, 3)
                .plain(line.direction.x(), 3)
                .plain(line.direction.y(), 3)
                .plain(line.direction.z(), 3)
                .estimate(g.value, r.confidence)
                .number(g.background.mean, g.background.standard_error)
                .plain(static_cast<double>(g.sources), 0)
                .text(o.worst == i ? "yes" : "")
                .text(g.reason);
            s.next_row();
        }
}

void add_schedule(Workbook& book, const std::vector<ScheduleEntry>& schedule) {
    if (schedule.empty())
        return;
    Sheet s(book,
            "Luminaires",
            {{"Type", 20},
             {"Count", 8},
             {"Flux of one [lm]", 11},
             {"Power of one [W]", 11},
             {"Ra", 7},
             {"Maintenance factor", 12},
             {"LLMF", 8},
             {"LSF", 8},
             {"LMF", 8},
             {"RSMF", 8},
             {"Manufacturer", 24},
             {"Product", 36},
             {"File", 36}});
    for (const ScheduleEntry& e : schedule) {
        s.text(e.type).plain(static_cast<double>(e.count), 0).plain(e.flux, 0);
        s.plain(e.watts.value_or(NAN), 1).plain(e.colour_rendering.value_or(NAN), 0);
        const MaintenanceFactor& m = e.maintenance;
        s.plain(m.value, 3);
        for (const double part : {m.lamp_flux, m.lamp_survival, m.luminaire, m.room_surface})
            s.plain(m.has_parts ? part : NAN, 3);
        s.text(e.manufacturer).text(e.product).text(e.file);
        s.next_row();
    }
}

void add_energy(Workbook& book, const Results& r) {
    if (r.energy.empty())
        return;
    Sheet s(book,
            "Energy",
            {{"Room", 24},
             {"Floor [m2]", 10},
             {"Power [W]", 10},
             {"Density [W/m2]", 11},
             {"Density [W/(m2 100 lx)]", 14},
             {"Standard error", 11},
             {"On surface", 28},
             {"LENI [kWh/(m2 a)]", 12},
             {"Remark", 40}});
    for (const EnergyResult& e : r.energy) {
        s.text(e.room).plain(e.floor_area, 2).plain(e.watts.value_or(NAN), 1);
        s.plain(e.watts ? e.density : NAN, 2);
        const Estimate& d = e.density_per_100_lux;
        s.plain(d.samples > 0 ? d.mean : NAN, 3)
            .plain(d.samples > 0 ? d.standard_error : NAN, 4);
        s.text(e.surface).plain(e.leni.value_or(NAN), 2).text(e.reason);
        s.next_row();
    }
}

void add_surface(Workbook& book,
                 const std::string& name,
                 const SurfaceResult& surface,
                 double confidence) {
    const std::string value = std::string(quantity_name(surface.surface.kind)) + " [lx]";
    Sheet s(book,
            name,
            {{"x [m]", 9},
             {"y [m]", 9},
             {"z [m]", 9},
             {"nx", 8},
             {"ny", 8},
             {"nz", 8},
             {value.c_str(), 14},
             {"Standard error [lx]", 11},
             {"Lower end [lx]", 11},
             {"Upper end [lx]", 11},
             {"Direct [lx]", 11},
             {"Indirect [lx]", 11},
             {"Flags", 24}});
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const Receiver& at = surface.surface.receivers[i];
        const PointResult& p = surface.points[i];
        for (const double c : {at.point.x, at.point.y, at.point.z})
            s.plain(c, 3);
        for (const double c : {at.axis.x(), at.axis.y(), at.axis.z()})
            s.plain(c, 3);
        s.estimate(p.total, confidence)
            .number(p.direct.mean, p.total.standard_error)
            .number(p.indirect.mean, p.total.standard_error);
        s.text(std::string(p.suspicious_replicate ? "suspicious replicate " : "")
               + (p.heavy_tail ? "heavy tail " : "") + (p.near_surface ? "near surface" : ""));
        s.next_row();
    }
}

void add_origin(Workbook& book, const ResultsDocument& d) {
    Sheet s(book, "Calculation", {{"What", 28}, {"Value", 70}});
    const auto add = [&](const std::string& what, const std::string& value) {
        s.text(what).text(value);
        s.next_row();
    };
    const auto add_number = [&](const char* what, double value, int decimals) {
        s.text(what).plain(value, decimals);
        s.next_row();
    };
    add("Project", d.project_name);
    add("isolux", d.version);
    add("Estimator", d.results.estimator);
    add_number("Tolerance", d.tolerance, 4);
    add_number("Confidence", d.confidence, 4);
    add("Seed", std::to_string(d.seed));
    add_number("Replicates", static_cast<double>(d.results.replicates), 0);
    add("Converged", d.results.converged ? "yes" : "no");
    add("All requirements", std::string(to_word(overall(d.results.verdicts))));
    add(d.project.file, "SHA-256 " + d.project.sha256);
    for (const InputFile& f : d.inputs)
        add(f.file, "SHA-256 " + f.sha256);
    for (const Message& m : d.results.notices)
        add("Notice", to_string(m));
}

void fill(Workbook& book, const ResultsDocument& d) {
    book.set_title(d.project_name);
    const Results& r = d.results;
    add_summary(book, r);
    add_verdicts(book, r);
    add_observers(book, r);
    add_schedule(book, d.schedule);
    add_energy(book, r);
    std::vector<std::string> names;
    for (const SurfaceResult& s : r.surfaces)
        names.push_back(s.surface.name);
    const std::vector<std::string> reserved{
        "Summary", "Verdicts", "Observers", "Luminaires", "Energy", "Calculation"};
    const std::vector<std::string> sheets = sheet_names(names, reserved);
    for (std::size_t i = 0; i < sheets.size(); ++i)
        add_surface(book, sheets[i], r.surfaces[i], r.confidence);
    add_origin(book, d);
}

/// An empty file beside the one to be written.
std::filesystem::path make_temporary(const std::filesystem::path& path) {
    std::string name = (path.parent_path() / ".isolux-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0)
        throw WriteError(path, std::error_code(errno, std::generic_category()));
    ::close(file);
    return name;
}

/// Removes its file in the end.
struct Draft {
    std::filesystem::path path;

    explicit Draft(std::filesystem::path file) : path(std::move(file)) {}

    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    ~Draft() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

} // namespace

std::vector<std::string> sheet_names(std::span<const std::string> names,
                                     std::span<const std::string> reserved) {
    std::set<std::string> taken;
    for (const std::string& r : reserved)
        taken.insert(lower(r));
    std::vector<std::string> sheets;
    for (const std::string& name : names) {
        std::string sheet = allowed(name);
        for (int n = 2; !taken.insert(lower(sheet)).second; ++n) {
            const std::string ending = " (" + std::to_string(n) + ")";
            sheet = cut_text(allowed(name), longest_sheet_name - ending.size()) + ending;
        }
        sheets.push_back(std::move(sheet));
    }
    return sheets;
}

void write_xlsx(const std::filesystem::path& path, const ResultsDocument& document) {
    // libxlsxwriter writes files only; its file becomes ours once it is whole.
    const Draft draft{make_temporary(path)};
    const auto& surfaces = document.results.surfaces;
    std::size_t rows = 0;
    for (const SurfaceResult& s : surfaces)
        rows += s.points.size();
    try {
        Workbook book(draft.path, surfaces.size(), rows);
        fill(book, document);
        book.close();
    } catch (const std::system_error& e) {
        throw WriteError(path, e.code());
    }
    write_file_safely(path, read_file_bytes(draft.path, FileLimits::results));
}

} // namespace isolux
