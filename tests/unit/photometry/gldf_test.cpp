#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/photometry/quantities.h"
#include "isolux/photometry/read_photometry.h"

#include "support/stored_zip.h"

namespace isolux {
namespace {

using test::stored_zip;
using test::ZipFile;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// 100 cd all over the lower hemisphere, times `scale`.
std::string ies(const std::string& scale) {
    return "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] l\n[ISSUEDATE] d\n[MANUFAC] m\nTILT=NONE\n"
           "1 -1 "
           + scale + " 2 1 1 2 0.2 0.4 0\n1 1 5\n0 90\n0\n100 100\n";
}

std::string product(const std::string& variants,
                    const std::string& first_file = "a.ies",
                    const std::string& type = "localFileName") {
    return "<?xml "
           "version=\"1.0\"?>\n<Root><Header><Manufacturer>Maker</Manufacturer></Header>\n"
           "<GeneralDefinitions><Files>\n<File id=\"f1\" contentType=\"ldc/ies\" type=\""
           + type + "\">" + first_file
           + "</File>\n<File id=\"f2\" contentType=\"ldc/ies\" "
             "type=\"localFileName\">b.ies</File>\n"
             "</Files><Photometries>\n"
             "<Photometry id=\"p1\"><PhotometryFileReference fileId=\"f1\"/></Photometry>\n"
             "<Photometry id=\"p2\"><PhotometryFileReference fileId=\"f2\"/></Photometry>\n"
             "</Photometries><Emitters>\n"
             "<Emitter id=\"e1\"><FixedLightEmitter>"
             "<PhotometryReference photometryId=\"p1\"/></FixedLightEmitter></Emitter>\n"
             "<Emitter id=\"e2\"><ChangeableLightEmitter emergencyBehaviour=\"EmergencyOnly\">"
             "<PhotometryReference photometryId=\"p1\"/></ChangeableLightEmitter>"
             "<ChangeableLightEmitter><Rotation><Z>90</Z></Rotation>"
             "<PhotometryReference photometryId=\"p2\"/></ChangeableLightEmitter></Emitter>\n"
             "<Emitter id=\"e3\"><FixedLightEmitter>"
             "<PhotometryReference photometryId=\"p9\"/></FixedLightEmitter></Emitter>\n"
             "<Emitter id=\"e4\"><FixedLightEmitter>"
             "<PhotometryReference "
             "photometryId=\"p1\"/><RatedLuminousFlux>5</RatedLuminousFlux>"
             "</FixedLightEmitter></Emitter>\n"
             "</Emitters></GeneralDefinitions><ProductDefinitions><ProductMetaData><Name>"
             "<Locale language=\"en\">Lamp</Locale></Name></ProductMetaData>\n<Variants>"
           + variants + "</Variants></ProductDefinitions></Root>\n";
}

std::string variant(const std::string& id, const std::vector<std::string>& emitters) {
    std::string text = "<Variant id=\"" + id + "\"><Geometry>";
    for (const std::string& e : emitters)
        text += "<EmitterReference emitterId=\"" + e + "\"/>";
    return text + "</Geometry></Variant>\n";
}

std::string container(const std::string& product_xml) {
    return stored_zip(
        {{"product.xml", product_xml}, {"ldc/a.ies", ies("1")}, {"ldc/b.ies", ies("3")}});
}

double axial(const LuminairePhotometry& l) {
    return intensity_towards(l, Angle(), Angle()).value();
}

std::string refusal(const std::string& bytes) {
    try {
        static_cast<void>(parse_photometry(bytes, "a.gldf"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "(not refused)";
}

std::string notices(const Parsed<LuminairePhotometry>& parsed) {
    std::string text;
    for (const Message& m : parsed.notices)
        text += to_string(m) + "\n";
    return text;
}

TEST(Gldf, ReadsTheFileOfTheFirstVariant) {
    const auto parsed = parse_photometry(container(product(variant("v1", {"e1"}))), "a.gldf");
    EXPECT_EQ(parsed.value.format, PhotometricFormat::gldf);
    EXPECT_EQ(parsed.value.contained_file, "a.ies");
    EXPECT_EQ(parsed.value.manufacturer, "Maker");
    EXPECT_EQ(parsed.value.name, "Lamp");
    EXPECT_NEAR(axial(parsed.value), 100.0, 1e-9);
    EXPECT_DOUBLE_EQ(parsed.value.opening.extent_x.value(), 0.4); // as LM-63 lays it
    EXPECT_EQ(notices(parsed), "");
}

TEST(Gldf, ChoosesAVariantByIdOrNumber) {
    const std::string bytes = container(product(variant("v1", {"e1"}) + variant("v2", {"e2"})));
    EXPECT_THAT(notices(parse_photometry(bytes, "a.gldf")),
                HasSubstr("2 variants (the first, 'v1', is taken)"));
    PhotometryOptions options;
    for (const std::string wanted : {"v2", "2"}) {
        options.variant = wanted;
        const auto parsed = parse_photometry(bytes, "a.gldf", options);
        EXPECT_NEAR(axial(parsed.value), 300.0, 1e-9);
        EXPECT_THAT(notices(parsed), HasSubstr("the first that is not for emergencies only"));
        EXPECT_THAT(notices(parsed),
                    HasSubstr("a.gldf/product.xml:11: the emitter is rotated"));
    }
    options.variant = "v3";
    EXPECT_THROW(static_cast<void>(parse_photometry(bytes, "a.gldf", options)), InputError);
}

TEST(Gldf, AddsUpTheEmittersOfAVariant) {
    const auto parsed =
        parse_photometry(container(product(variant("v1", {"e1", "e2", "e1"}))), "a.gldf");
    EXPECT_NEAR(axial(parsed.value), 500.0, 1e-9);
    EXPECT_EQ(parsed.value.input_watts, 15.0);
    EXPECT_THAT(notices(parsed), HasSubstr("3 emitters (all shine at full power"));
}

TEST(Gldf, ComparesTheRatedFluxButNeverScales) {
    const auto parsed = parse_photometry(container(product(variant("v1", {"e4"}))), "a.gldf");
    EXPECT_NEAR(axial(parsed.value), 100.0, 1e-9);
    EXPECT_THAT(notices(parsed), HasSubstr("rated flux 5 lm"));
}

TEST(Gldf, RefusesReferencesThatLeadNowhereWithTheirLine) {
    EXPECT_THAT(refusal(container(product(variant("v1", {"e7"})))),
                HasSubstr("EmitterReference names 'e7', which Emitters does not have"));
    EXPECT_THAT(refusal(container(product(variant("v1", {"e3"})))),
                StartsWith("a.gldf/product.xml:12: PhotometryReference names 'p9'"));
    EXPECT_THAT(refusal(container(product(variant("v1", {"e1"}), "missing.ies"))),
                StartsWith("a.gldf/product.xml:4: ldc/missing.ies is not in the container"));
    EXPECT_THAT(refusal(container(product(variant("v1", {"e1"}), "http://x/a.ies", "url"))),
                HasSubstr("nothing is fetched"));
}

TEST(Gldf, NeverLeavesTheContainer) {
    for (const std::string name :
         {"../../etc/passwd", "/etc/passwd", "x/../../a", "c:a.ies", "..\\a.ies"})
        EXPECT_THAT(refusal(container(product(variant("v1", {"e1"}), name))),
                    HasSubstr("leads out of the container"))
            << name;
}

TEST(Gldf, RefusesBombsAndDamage) {
    const std::string xml = product(variant("v1", {"e1"}));
    EXPECT_THAT(refusal(stored_zip({{"product.xml", xml}, {"ldc/a.ies", "x", 2'000'000'000}})),
                HasSubstr("a decompression bomb?"));
    EXPECT_THAT(refusal(stored_zip({{"product.xml", xml}, {"ldc/a.ies", "x", 5'000}})),
                HasSubstr("a decompression bomb?"));
    std::string damaged = container(xml);
    damaged[damaged.find("100 100")] = '9';
    EXPECT_THAT(refusal(damaged), HasSubstr("is damaged"));
    EXPECT_THAT(refusal(container(xml).substr(0, 400)), HasSubstr("cannot be opened"));
    EXPECT_THAT(refusal(stored_zip({{"readme.txt", "x"}})), HasSubstr("without product.xml"));
    EXPECT_THAT(refusal(stored_zip({{"product.xml", xml}, {"ldc/a.ies", container(xml)}})),
                HasSubstr("a container within the container"));
    EXPECT_THAT(refusal(container("<Other/>")), HasSubstr("the root is 'Other'"));
}

TEST(Gldf, TellsWhatIsOddInTheFileInside) {
    std::string odd = ies("1");
    odd.replace(odd.find("1 1 5"), 5, "1 7 5");
    const auto parsed = parse_photometry(
        stored_zip({{"product.xml", product(variant("v1", {"e1"}))}, {"ldc/a.ies", odd}}),
        "a.gldf");
    EXPECT_THAT(notices(parsed), StartsWith("a.gldf/ldc/a.ies:8: 7 in the field kept"));
    PhotometryOptions strict;
    strict.strict = true;
    EXPECT_THROW(
        static_cast<void>(parse_photometry(
            stored_zip({{"product.xml", product(variant("v1", {"e1"}))}, {"ldc/a.ies", odd}}),
            "a.gldf",
            strict)),
        InputError);
}

} // namespace
} // namespace isolux
