#include "isolux/report/texts.h"

namespace isolux::report {

namespace {

Texts make_english() {
    Texts t;
    t.language = "en";

    t.kind = "Lighting calculation";
    t.cover_caption = "About this calculation";
    t.project = "Project";
    t.project_file = "Project file";
    t.date = "Calculated on";
    t.no_date = "not recorded";
    t.program = "Calculated by";
    t.program_value = "isolux {}";
    t.accuracy = "Accuracy asked for";
    t.accuracy_value = "every value within {} at {} confidence";
    t.state = "State";
    t.state_converged = "complete: every value is as accurate as asked for";
    t.state_open = "some values are less accurate than asked for; they are marked";
    t.state_interrupted = "stopped early; values are less accurate than asked for";
    t.contents = "Contents";
    t.footer = "{} · isolux {}";

    t.verdict_title = "Verdict";
    t.verdict_intro =
        "A requirement is met where the whole interval lies on the right side of the limit, "
        "not "
        "met where it lies on the wrong side, undecided where the limit lies inside the "
        "interval; "
        "the intervals hold at {} confidence for every look at the errors that the calculation "
        "took before it stopped, and are therefore wider than those of the single figures in "
        "this report. The margin is the distance of the value from the limit, positive on the "
        "right side.";
    t.verdict_caption = "Requirements and what was found";
    t.requirement = "Requirement";
    t.standard = "Standard";
    t.limit = "Limit";
    t.margin = "Margin";
    t.verdict = "Verdict";
    t.pass = "pass";
    t.fail = "fail";
    t.undecided = "undecided";
    t.not_judged = "not judged";
    t.all_pass = "every requirement that could be judged is met";
    t.one_fails = "at least one requirement is not met";
    t.one_undecided = "at least one interval contains its limit; none lies on the wrong side";
    t.none_judged = "no requirement could be judged";
    t.recommended = "recommended";
    t.verdict_note = "{}, {}: {}";
    t.source_caption = "Where the limits come from";
    t.task = "In words";
    t.clause = "Clause";
    t.source = "Source of the number";
    t.recalled = "(recalled, not compared with the printed standard)";

    t.glare = "Glare";
    t.glare_intro = "The worst of each group of observers, and all lines of sight.";
    t.glare_caption = "Observers";
    t.observers = "Observers";
    t.sight_lines = "Lines of sight";
    t.scale = "Scale";
    t.worst = "Worst";
    t.eye = "Eye";
    t.looking = "Looking";
    t.by_table = "Table method";
    t.ratings_caption = "{}, {} of all lines of sight";
    t.background = "Background, cd/m²";
    t.energy = "Energy";
    t.energy_caption = "Installed power and energy by room";
    t.watts = "Power, W";
    t.density = "W/m²";
    t.density_per_100_lux = "W/m² per 100 lx";
    t.leni = "LENI, kWh/(m² a)";
    t.scenes = "Light scenes";
    t.scenes_intro = "Recombined from the contributions of the luminaires, without a new "
                     "calculation.";
    t.scene_caption = "Scene {}";
    t.maintenance_caption = "Maintenance factors";
    t.maintenance_factor = "Maintenance factor";

    t.overview = "Results at a glance";
    t.overview_intro =
        "Values are followed by half the width of their {} confidence interval, which says how "
        "exactly they were calculated from the data given. Section “Method” tells what else "
        "they depend on.";
    t.surfaces_caption = "Calculation surfaces";
    t.surface = "Surface";
    t.quantity = "Quantity";
    t.points = "Points";
    t.mean = "Em";
    t.minimum = "Emin";
    t.maximum = "Emax";
    t.uniformity = "U0";
    t.diversity = "Ud";
    t.lux = "lx";
    t.reached = "Accurate enough";
    t.yes = "yes";
    t.no = "no";
    t.notices = "Notices of the program";
    t.place = "Place";
    t.notice = "Notice";

    t.luminaires = "Luminaires";
    t.schedule_caption = "Luminaire schedule";
    t.number = "No.";
    t.type = "Type";
    t.product = "Product";
    t.count = "Count";
    t.flux_each = "lm each";
    t.flux_all = "lm in all";
    t.watts_each = "W each";
    t.watts_all = "W in all";
    t.not_stated = "not stated";
    t.total = "Total";
    t.schedule_note = "Luminous flux and power of new luminaires at full output.";
    t.polar_caption = "Luminous intensity of {}, cd";
    t.polar_alternative =
        "Polar diagram of {}: largest luminous intensity {} cd at C {}, gamma {} degrees";
    t.facts_caption = "{}: {}";
    t.manufacturer = "Manufacturer";
    t.catalogue_number = "Catalogue number";
    t.file = "File";
    t.lamps = "Lamps";
    t.flux = "Luminous flux";
    t.power = "Power";
    t.power_value = "{} W, {} lm/W";
    t.light_output_ratio = "Light output ratio";
    t.downward_share = "Downward share";
    t.largest_intensity = "Largest intensity";
    t.largest_intensity_value = "{} cd at C {}°, gamma {}°";
    t.beam = "Beam angle";
    t.beam_value = "C0-C180 {}, C90-C270 {}";
    t.body = "Body (x × y × z)";
    t.long_side = "In the room";
    t.aligned = "length axis aligned to x by the project";
    t.legend = "Solid: C0-C180, C0 at the right. Dashed: C90-C270, C90 at the right.";
    t.positions_caption = "Luminaires as they hang";
    t.luminaire = "Luminaire";
    t.c0_direction = "C0";
    t.tilt = "Tilt";
    t.light_share = "Light";
    t.group = "Group";
    t.positions_note =
        "x, y, z: photometric centre, m. C0: direction of C0 from x towards y, degrees. Tilt: "
        "of gamma 0 from straight down, degrees. Light: dimming times maintenance factor.";

    t.rooms = "Rooms";
    t.room_caption = "{}: walls in metres; numbers in luminaires are types of the schedule, "
                     "arrows point to C0";
    t.room_alternative =
        "Plan of {} with wall lengths, {} luminaires and {} calculation surfaces";
    t.rooms_table = "Rooms of the project";
    t.finishes_table = "Surfaces as calculated: area, and the shares of light they reflect "
                       "diffusely, reflect as a mirror and let pass";
    t.room_or_object = "Room or object";
    t.part = "Part";
    t.material = "Material";
    t.diffuse_share = "Reflectance";
    t.mirror_share = "Mirror";
    t.transmittance = "Transmittance";
    t.room = "Room";
    t.area = "Floor area, m²";
    t.surface_area = "Area, m²";
    t.height = "Height, m";
    t.luminaire_count = "Luminaires";
    t.plan_caption = "Plan";

    t.surface_title = "{}";
    t.figures_caption = "Figures of the surface";
    t.value = "Value";
    t.lower = "Lower";
    t.upper = "Upper";
    t.map_caption = "{}: values in lx, isolux lines and false colours";
    t.map_alternative = "Map of {} on {}: mean {} lx, lowest {} lx, highest {} lx";
    t.values_caption = "Values at all points of {}, {}";
    t.point = "Point";
    t.direct = "Direct";
    t.indirect = "Reflected";
    t.values_cut = "{} of {} points are listed here; all are in the surface's CSV file and in "
                   "results.json.";
    t.flag_note = "* the interval of this point deserves less trust (see METHODS 3.5).";
    t.not_reached = "Some values of this surface are less accurate than asked for.";

    t.views = "Views";
    t.view_caption = "{}";

    t.method = "Method and uncertainty";
    t.method_intro =
        "Light that reaches a point straight from a luminaire is integrated over the luminous "
        "opening; light that was reflected is estimated by Monte Carlo methods without bias. "
        "The calculation is repeated as independent replicates, whose spread gives the "
        "confidence intervals. Every equation is in METHODS.md of the program.";
    t.method_caption = "How these results were calculated";
    t.estimator = "Reflected light";
    t.seed = "Seed";
    t.tolerance = "Tolerance";
    t.confidence = "Confidence";
    t.confidence_value = "{} asked for; each interval holds at {}";
    t.replicates = "Independent replicates";
    t.paths = "Light paths";
    t.rays = "Rays";
    t.flux_balance = "Flux balance";
    t.flux_balance_value = "{} lm emitted, {} lm absorbed, {} lm escaped";
    t.self_test = "Self-test";
    t.self_test_absent = "not part of this folder; `isolux selftest -o` with this folder and "
                         "`isolux report` add it";
    t.self_test_value = "{} of {} comparisons with known answers passed (isolux {}, seed {})";
    t.duration = "Duration";
    t.duration_value = "{} s, {} s of processor time";
    t.budget_title = "Uncertainty budget";
    t.budget_intro =
        "Monte Carlo: measured, half the width of the interval of Em. The other components are "
        "assumptions, not measurements, at about 95 % coverage: measured photometry ± {}, "
        "luminous flux of the luminaires against their rating ± {}, reflected light for "
        "reflectances that differ from those given ± {}, maintenance factor ± {}. Independent "
        "components add up by squares; the share in brackets is that of the sum of squares.";
    t.budget_caption = "Uncertainty of Em by component";
    t.monte_carlo = "Monte Carlo";
    t.photometry = "Photometry";
    t.assumed_flux = "Luminous flux";
    t.reflectance = "Reflectances";
    t.maintenance = "Maintenance";
    t.combined = "Combined";
    t.hashes_title = "Input files";
    t.hashes_intro = "A file that gives the same SHA-256 is the same file to the last bit.";
    t.hashes_caption = "SHA-256 of all inputs";
    t.sha256 = "SHA-256";
    return t;
}

} // namespace

const Texts& english() {
    static const Texts texts = make_english();
    return texts;
}

} // namespace isolux::report
