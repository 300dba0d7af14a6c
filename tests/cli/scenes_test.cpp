#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/results_json.h"

#include "cli/program.h"
#include "support/sample_results.h"

namespace isolux::test {
namespace {

using testing::HasSubstr;

/// Results with the light of two sources in the table, half of it from each.
std::string write_results_with_sources(const TemporaryFolder& folder) {
    Project project;
    project.name = "Office";
    project.file = {"office.json", std::string(64, 'a')};
    Results r = make_results();
    Contributions c;
    c.sources = {{"board", SourceKind::group, 1000.0, {0, 1}},
                 {"pupils", SourceKind::group, 3000.0, {2}}};
    c.replicates = 16;
    for (const SurfaceResult& s : r.surfaces)
        c.points += s.points.size();
    for (std::size_t source = 0; source < 2; ++source)
        for (std::size_t i = 0; i < 16; ++i)
            for (const SurfaceResult& s : r.surfaces)
                for (const double e : s.replicates.row(i)) {
                    c.direct.push_back(static_cast<float>(0.3 * e));
                    c.indirect.push_back(static_cast<float>(0.2 * e));
                }
    r.contributions = c;
    Verdict glare = r.verdicts.front();
    glare.requirement.symbol = "UGR";
    glare.requirement.quantity = RequiredQuantity::unified_glare_rating;
    glare.requirement.area = RequiredArea::observers;
    glare.subject = "desk";
    r.verdicts.push_back(glare);
    SceneResult scene{"talk", {0.5, 0.5, 1.0}, {}, {}, {}};
    for (const SurfaceResult& s : r.surfaces)
        scene.surfaces.push_back(s.summary);
    r.scenes = {scene};
    write_results(folder.path("out"), make_results_document(project, {}, r));
    return folder.path("out");
}

TEST(ScenesVerb, ShowsTheProjectsScenesWithTheirVerdicts) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"scenes", write_results_with_sources(folder)});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("scene: talk\n"));
    EXPECT_THAT(ran.out, HasSubstr("fail")); // 3/4 of the light of the run that passed
}

TEST(ScenesVerb, ListsWhatIsNotJudgedWithTheReason) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"scenes", write_results_with_sources(folder)});
    EXPECT_THAT(ran.out, HasSubstr("(limits: 1 fail, 2 not judged)"));
    EXPECT_THAT(
        ran.out,
        HasSubstr("UGR is not judged in scenes: what reaches the eyes is not kept apart "
                  "by luminaire\n"));
    EXPECT_THAT(ran.out, HasSubstr("not stated\n")); // Ra, as in the run
}

TEST(ScenesVerb, TakesLevelsFromTheCommandLine) {
    const TemporaryFolder folder;
    const std::string out = write_results_with_sources(folder);
    Ran ran = run_program({"scenes", out, "board=0", "--others", "2"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("scene: board=0\n"));
    // Twice the half of the light is the light itself.
    const std::string half = run_program({"scenes", out, "--others", "1"}).out;
    EXPECT_EQ(ran.out.substr(ran.out.find('\n')), half.substr(half.find('\n')));
}

TEST(ScenesVerb, TakesPercentages) {
    const TemporaryFolder folder;
    const std::string out = write_results_with_sources(folder);
    const Ran percent = run_program({"scenes", out, "board=50%", "--others", "25%"});
    EXPECT_EQ(percent.exit_code, 0);
    EXPECT_EQ(percent.err, "");
    const Ran share = run_program({"scenes", out, "board=0.5", "--others", "0.25"});
    EXPECT_EQ(percent.out.substr(percent.out.find('\n')),
              share.out.substr(share.out.find('\n')));
}

TEST(ScenesVerb, NoticesMoreThanAllOfTheLight) {
    const TemporaryFolder folder;
    const std::string out = write_results_with_sources(folder);
    const Ran ran = run_program({"scenes", out, "board=50"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(
        ran.err,
        "notice: isolux scenes: 'board=50' is 5000 % of the light that was calculated. 0.5 "
        "or 50% for 50 %?\n");
    EXPECT_EQ(
        run_program({"scenes", out, "board=150%"}).err,
        "notice: isolux scenes: 'board=150%' is 150 % of the light that was calculated\n");
}

TEST(ScenesVerb, ListsTheNamesThatCanBeSet) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"scenes", write_results_with_sources(folder)});
    EXPECT_THAT(ran.out,
                HasSubstr("levels can be set for\n  board (2 luminaires, 1000 lm)\n  pupils (1 "
                          "luminaire, 3000 lm)\n"));
}

TEST(ScenesVerb, SaysThatTypesAreNotKeptApart) {
    const TemporaryFolder folder;
    const std::string text = R"({"isolux": 1,
        "maintenance_factor": 0.8, "settings": {"tolerance": "20%"},
        "rooms": [{"size": [3, 3], "height": 3}],
        "luminaire_types": {"bulb": {"isotropic": {"flux": 500}}},
        "luminaires": [{"type": "bulb", "position": [1, 1, 2], "group": "a"},
                       {"type": "bulb", "position": [2, 2, 2], "group": "b"}],
        "surfaces": [{"points": [[1, 2, 0.75]]}],
        "scenes": [{"name": "half", "others": 0.5}]})";
    const std::string project = folder.write("p.json", text);
    Ran ran = run_program({"run", project, "-o", folder.path("out"), "--quiet"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    ran = run_program({"scenes", folder.path("out"), "bulb=0.5"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux scenes: the light in these results is not kept apart by luminaire "
              "type, as 'bulb' asks (it is kept by group; names: a, b). \"contributions\": "
              "\"luminaires\" in the project's settings keeps every luminaire apart\n");

    std::string apart = text;
    apart.insert(apart.find("\"tolerance\""), "\"contributions\": \"luminaires\", ");
    const std::string second = folder.write("q.json", apart);
    ran = run_program({"run", second, "-o", folder.path("apart"), "--quiet"});
    ran = run_program({"scenes", folder.path("apart"), "a=0.5"});
    EXPECT_EQ(ran.err,
              "error: isolux scenes: the light in these results is not kept apart by group, as "
              "'a' asks (it is kept by luminaire; names: bulb 1, bulb 2)\n");
}

TEST(ScenesVerb, ComplainsAboutNamesLevelsAndMissingTables) {
    const TemporaryFolder folder;
    const std::string out = write_results_with_sources(folder);
    Ran ran = run_program({"scenes", out, "bord=1"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux scenes: there is no light source 'bord' in these results. Did you "
              "mean 'board'?\n");
    ran = run_program({"scenes", out, "board=x"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("'board=x' is no level (NAME=LEVEL, 0 is off"));
    ran = run_program({"scenes", out, "board"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("'board' is no level (NAME=LEVEL is expected)"));
    ran = run_program({"scenes", folder.path()});
    EXPECT_EQ(ran.exit_code, 2);
}

} // namespace
} // namespace isolux::test
