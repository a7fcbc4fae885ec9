#include "core/scene/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/words/encoding.hpp"

namespace {

using breach::fault::BadInput;
using breach::scene::apply_override;
using breach::scene::complete_and_check;
using breach::scene::parse_json;
using nlohmann::json;

const json schema = json::parse(R"({
    "type": "object", "additionalProperties": false, "required": ["speed"],
    "properties": {
        "speed": {"type": "number", "exclusiveMinimum": 0, "unit": "m/s", "description": "how fast"},
        "count": {"type": "integer", "minimum": 1, "default": 3},
        "mode": {"type": "string", "enum": ["slow", "fast"], "default": "slow"},
        "part": {"type": "object", "additionalProperties": false, "default": {},
                 "properties": {"depth": {"type": "number", "default": 2.5}}},
        "shape": {"oneOf": [{"$ref": "#/$defs/disc"}, {"$ref": "#/$defs/box"}]}
    },
    "$defs": {
        "disc": {"type": "object", "additionalProperties": false, "required": ["radius"],
                 "properties": {"type": {"const": "disc"}, "radius": {"type": "number"}}},
        "box": {"type": "object", "additionalProperties": false, "required": ["side"],
                "properties": {"type": {"const": "box"}, "side": {"type": "number"}}}
    }})");

TEST(Schema, FillsDefaultsAtEveryDepth) {
    json document = json::parse(R"({"speed": 1})");
    EXPECT_TRUE(complete_and_check(document, schema).empty());
    EXPECT_EQ(document, json::parse(R"({"speed":1,"count":3,"mode":"slow","part":{"depth":2.5}})"));
}

TEST(Schema, NamesEveryFaultAtOnceWithItsPointer) {
    json document =
        json::parse(R"({"speeed": 1, "count": 0.5, "mode": "medium", "part": {"depth": "deep"},
                                    "shape": {"type": "disc", "radius": "wide", "side": 1}})");
    std::vector<std::string> pointers;
    for (const auto& fault : complete_and_check(document, schema))
        pointers.push_back(fault.pointer);
    std::sort(pointers.begin(), pointers.end());
    const std::vector<std::string> expected{
        "", "/count", "/mode", "/part/depth", "/shape/radius", "/shape/side", "/speeed"};
    EXPECT_EQ(pointers, expected);
}

TEST(Schema, SuggestsTheKeyThatWasMeant) {
    json document = json::parse(R"({"sped": 1, "speed": 1})");
    const auto faults = complete_and_check(document, schema);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].remedy, "did you mean \"speed\"?");
}

TEST(Schema, ChoosesTheAlternativeByItsType) {
    json good = json::parse(R"({"speed": 1, "shape": {"type": "box", "side": 2}})");
    EXPECT_TRUE(complete_and_check(good, schema).empty());
    json bad = json::parse(R"({"speed": 1, "shape": {"type": "cone"}})");
    const auto faults = complete_and_check(bad, schema);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].pointer, "/shape/type");
    EXPECT_NE(faults[0].remedy.find("disc"), std::string::npos);
}

TEST(Schema, RefusesEveryWrongType) {
    for (const char* text :
         {R"({"speed": null})", R"({"speed": "1"})", R"({"speed": [1]})", R"({"speed": 0})",
          R"({"speed": true})", R"([1])", R"(7)", R"({"speed":1,"shape":3})"}) {
        json document = json::parse(text);
        EXPECT_FALSE(complete_and_check(document, schema).empty()) << text;
    }
}

/// The refusal of a text that has more faults than are listed.
BadInput refusal_of(const std::string& text) {
    try {
        json document = parse_json(text, "x");
        complete_and_check(document, schema, "x");
    } catch (const BadInput& bad) {
        return bad;
    }
    return {"nothing was thrown", std::vector<breach::fault::Fault>{}};
}

TEST(Schema, ListsTheFirstHundredFaultsAndCountsTheOthers) {
    std::string keys;
    for (int i = 0; i < 5000; ++i) keys += "\"key" + std::to_string(i) + "\": 1, ";
    const BadInput bad = refusal_of("{" + keys + "\"speed\": 1}");
    EXPECT_EQ(bad.faults().size(), 100u);
    EXPECT_EQ(bad.more(), 4900u);
    EXPECT_EQ(bad.faults()[0].pointer, "/key0");
    EXPECT_EQ(bad.count(), "5000 faults, of which these are the first 100");
    EXPECT_EQ(std::string(bad.what()).substr(0, 48), "x: " + bad.count());
}

TEST(StrictJson, BoundsKeysListsAndTexts) {
    std::string many;
    for (int i = 0; i < 30000; ++i)
        many += (i > 0 ? ", \"" : "\"") + std::to_string(i) + "\": [{}]";
    const BadInput keys = refusal_of("{" + many + "}");
    EXPECT_EQ(keys.faults().size(), 100u);
    EXPECT_EQ(keys.more(), 19900u);
    std::string twice;
    for (int i = 0; i < 300; ++i) twice += "\"a\": 1, ";
    EXPECT_EQ(refusal_of("{" + twice + "\"a\": 1}").more(), 200u);
    const std::string longest(1 << 20, 'k');
    for (const std::string& text : {"{\"" + longest + "\": 1}", "{\"speed\": " + longest + "}"}) {
        const BadInput bad = refusal_of(text);
        ASSERT_EQ(bad.faults().size(), 1u);
        EXPECT_LT(bad.faults()[0].cause.size(), 1200u);
    }
}

TEST(StrictJson, RefusesWhatOrdinaryParsersLetPass) {
    EXPECT_THROW(parse_json(R"({"a": 1, "a": 2})", "x"), BadInput);
    EXPECT_THROW(parse_json(R"({"a": 1e400})", "x"), BadInput);
    EXPECT_THROW(parse_json(R"({"a": NaN})", "x"), BadInput);
    EXPECT_THROW(parse_json("{\"a\": \"\xff\"}", "x"), BadInput);
    EXPECT_THROW(parse_json("{\"a\": 1", "x"), BadInput);
    EXPECT_THROW(parse_json("", "x"), BadInput);
    EXPECT_THROW(parse_json(std::string(100, '[') + std::string(100, ']'), "x"), BadInput);
    EXPECT_NO_THROW(parse_json(R"({"a": {"b": 1}, "c": {"b": 2}})", "x"));
    EXPECT_THROW(parse_json(R"({"a": {"b/c": 1}})", "x"), BadInput);
    EXPECT_THROW(parse_json(R"({"b~c": 1})", "x"), BadInput);
}

TEST(StrictJson, NamesUtf16) {
    for (const std::string& text :
         {std::string("\xFF\xFE{\0}\0", 6), std::string("\xFE\xFF\0{\0}", 6),
          std::string("{\0}\0", 4), std::string("\0{\0}", 4)})
        try {
            parse_json(text, "x");
            ADD_FAILURE();
        } catch (const BadInput& bad) {
            EXPECT_TRUE(bad.faults().at(0).cause.starts_with("is UTF-16"));
        }
    EXPECT_NO_THROW(parse_json("\xEF\xBB\xBF{}", "x"));  // the mark of UTF-8
}

TEST(StrictJson, NamesOtherEncodingsWithARemedyAndEchoesNoRawByte) {
    const auto told = [](const std::string& text) {
        try {
            parse_json(text, "x");
        } catch (const BadInput& bad) {
            return bad.faults().at(0).cause + " | " + bad.faults().at(0).remedy;
        }
        return std::string();
    };
    EXPECT_EQ(told("{\n\"B\xF6schung\": 1}"),
              "is not UTF-8 text (line 2): it looks like Latin-1 (ISO-8859-1) | save it as UTF-8 "
              "(iconv -f ISO-8859-1 -t UTF-8 FILE)");
    EXPECT_NE(told(std::string("\xFF\xFE\0\0{\0\0\0", 8)).find("iconv -f UTF-32 "),
              std::string::npos);
    EXPECT_NE(told(std::string("{\0\0\0}\0\0\0", 8)).find("iconv -f UTF-32LE "), std::string::npos);
    EXPECT_NE(told(std::string("\x1F\x8B\x08\0", 4)).find("it is no text"), std::string::npos);
    EXPECT_EQ(breach::words::first_not_utf8(told("{\xC3\xB6}")), std::string::npos);
}

TEST(Override, SetsNumbersWordsAndNewKeys) {
    json document = json::parse(R"({"a": {"b": 1}, "list": [1, 2]})");
    EXPECT_TRUE(apply_override(document, "/a/b=2.5").empty());
    EXPECT_TRUE(apply_override(document, "/a/word=fast").empty());
    EXPECT_TRUE(apply_override(document, "/list=[3]").empty());
    EXPECT_EQ(document, json::parse(R"({"a": {"b": 2.5, "word": "fast"}, "list": [3]})"));
}

TEST(Override, NamesTheNearMaterialOrTheLengthOfTheListThatItMisses) {
    json document = json::parse(
        R"({"materials": {"slope_soil": {"density": 1}}, "fem": {"stages": [{}, {}, {}]}})");
    const json before = document;
    const auto told = [&](const std::string& assignment) {
        std::string all;
        for (const auto& each : apply_override(document, assignment))
            all += each.pointer + ": " + each.cause + " | " + each.remedy;
        return all;
    };
    EXPECT_EQ(told("/materials/slope_soli/law/c_kPa=5"),
              "/materials/slope_soli/law/c_kPa: there is no material \"slope_soli\" | did you mean "
              "\"slope_soil\"?");
    EXPECT_EQ(told("/materials/clay/density=5"),
              "/materials/clay/density: there is no material \"clay\" | the materials are "
              "slope_soil; give a new one as a whole: /materials/clay={...}");
    for (const char* place : {"7", "4", "99999999999999999999"})
        EXPECT_NE(told("/fem/stages/" + std::string(place) + "/duration=1")
                      .find("/fem/stages has 3 stages, 0 to 2"),
                  std::string::npos);
    EXPECT_EQ(document, before);
    EXPECT_EQ(told("/materials/clay={\"density\": 2}"), "");
    EXPECT_EQ(told("/materials/clay/density=3"), "");
    EXPECT_EQ(told("/fem/stages/3/duration=1"), "") << "one more, entry by entry";
    EXPECT_EQ(told("/fem/stages/-={}"), "");
    EXPECT_EQ(told("/fem/stages/4={}"), "");
    EXPECT_EQ(told("/fem/stages/4/duration=2"), "");
    EXPECT_EQ(told("/lem/non_circular/vertices=13"), "");
}

TEST(Override, SaysWhatIsWrongWithAnAssignment) {
    json document = json::parse(R"({"a": {"b": 1}, "list": [1, 2]})");
    EXPECT_FALSE(apply_override(document, "a/b=1").empty());
    EXPECT_FALSE(apply_override(document, "/a/b").empty());
    EXPECT_FALSE(apply_override(document, "/a/b/c=1").empty());
    EXPECT_FALSE(apply_override(document, "/list/x=1").empty());
    EXPECT_EQ(document, json::parse(R"({"a": {"b": 1}, "list": [1, 2]})"));
}

}  // namespace
