// Every BSDF of docs/formats/scene.md, read from a scene's XML, against harness/oracles/bsdfs.py. That program
// evaluates the published formulas and shares no code with the renderer. Tolerances of each value: 2e-4 in single
// precision, and 6e-3 for `roughplastic`, whose transmittance is a fitted polynomial (within 2e-3 a crossing). Albedos,
// by quadrature here, have 3e-3. `every_parameter_is_seen` proves the power: the same comparison fails with any one
// number 5 % off, any switch turned or any two parameters exchanged. It also fails for a wrong default.

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <utility>

#include "renderer/bsdfs/test_albedo.h"
#include "renderer/integrators/test_scenes.h"
#include "scenes/description/named_ior.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

struct Row {
  std::string kind;
  std::vector<double> angles, expected;
};
struct Case {
  std::string xml;
  std::vector<Row> rows;
};

std::vector<double> numbers(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> all;
  for (double value; in >> value;) all.push_back(value);
  return all;
}

std::vector<Case> read_cases() {
  std::ifstream in(PHOTONPROOF_SOURCE_DIR "/harness/oracles/bsdfs_expected.tsv");
  std::vector<Case> all;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream fields(line);
    std::string kind, first, second;
    std::getline(fields, kind, '\t');
    std::getline(fields, first, '\t');
    std::getline(fields, second, '\t');
    if (kind == "case")
      all.push_back({first, {}});
    else
      all.back().rows.push_back({kind, numbers(first), numbers(second)});
  }
  return all;
}

CompiledBsdf compile(const std::string& xml) {
  const SceneDescription scene = parse_scene_text(
      "<scene version='3.0.0'><sensor type='perspective'/><emitter type='constant'/><shape type='sphere'>" + xml +
          "</shape></scene>",
      "test.xml");
  return compile_bsdf(scene, {static_cast<std::uint32_t>(scene.bsdfs.size() - 1)});  // the last nests the others
}

Vec3f direction(const std::vector<double>& angles, std::size_t first) {
  const double theta = angles.at(first) * std::numbers::pi / 180, phi = angles.at(first + 1) * std::numbers::pi / 180;
  return Vec3f(Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
}

void append(std::vector<double>& all, const Vec3f& v) {
  for (const float x : {v.x, v.y, v.z}) all.push_back(double{x});
}

constexpr float last_below_one = 1 - 0x1p-24f;

/// Values of the BSDF in the order of a row's `expected`; shorter where a lobe is missing.
std::vector<double> found(const Bsdf& bsdf, const Row& row) {
  std::vector<double> all;
  const Vec3f wo = direction(row.angles, 0);
  if (row.kind == "eval") append(all, test::eval(bsdf, wo, direction(row.angles, 2)));
  if (row.kind == "pdf") all.push_back(double{test::pdf(bsdf, wo, direction(row.angles, 2))});
  if (row.kind == "albedo") all.push_back(test::albedo_by_quadrature(bsdf, double{wo.z}, 160));
  if (row.kind == "mirror") {
    const auto drawn = test::sample(bsdf, wo, 0, {0.5f, 0.5f}, TransportMode::radiance);
    const bool mirrors = drawn && drawn->delta;
    if (mirrors) {
      EXPECT_EQ(drawn->wi_local, Vec3f(-wo.x, -wo.y, wo.z));
    }
    append(all, mirrors ? drawn->weight * drawn->pdf : Vec3f(0.0f));
  }
  if (row.kind == "reflection" || row.kind == "refraction") {
    const float u = row.kind == "reflection" ? 0 : last_below_one;
    const auto radiance = test::sample(bsdf, wo, u, {0.5f, 0.5f}, TransportMode::radiance);
    const auto importance = test::sample(bsdf, wo, u, {0.5f, 0.5f}, TransportMode::importance);
    if (!radiance || !importance || !radiance->delta) return {};
    append(all, radiance->wi_local);
    all.push_back(double{radiance->pdf});
    append(all, radiance->weight);
    append(all, importance->weight);
    all.push_back(double{radiance->eta});
  }
  return all;
}

/// The rows that do not agree, one a line; or only the first.
std::string disagreements(const Case& a_case, const Bsdf& bsdf, bool all_rows = true) {
  std::ostringstream text;
  const bool fitted = a_case.xml.find("'roughplastic'") != std::string::npos;
  for (const Row& row : a_case.rows) {
    const double tolerance = row.kind == "albedo" ? 3e-3 : fitted ? 6e-3 : 2e-4;
    const std::vector<double> has = found(bsdf, row);
    bool agrees = has.size() == row.expected.size();
    for (std::size_t i = 0; agrees && i < has.size(); ++i)
      agrees = std::abs(has[i] - row.expected[i]) <= tolerance * std::abs(row.expected[i]) + 1e-6;
    if (agrees) continue;
    text << "  " << row.kind;
    for (const double angle : row.angles) text << " " << angle;
    text << ":";
    for (std::size_t i = 0; i < has.size(); ++i) text << " " << has[i] << " for " << row.expected[i];
    text << "\n";
    if (!all_rows) break;
  }
  return text.str();
}

TEST(bsdf_oracle, every_bsdf_has_the_values_of_the_published_formulas) {
  const std::vector<Case> cases = read_cases();
  EXPECT_GT(cases.size(), 30u);
  for (const Case& a_case : cases) {
    EXPECT_GT(a_case.rows.size(), 4u);
    EXPECT_EQ(disagreements(a_case, compile(a_case.xml).record), "") << a_case.xml;
  }
}

/// Variants of the XML with one error each: a number 5 % larger (0.05 where it is 0), a switch turned, a name
/// exchanged, or two parameters of one kind swapped.
std::vector<std::string> wrong_ones(const std::string& xml) {
  std::vector<std::string> all;
  const auto with = [&](std::size_t at, std::size_t length, const std::string& text) {
    all.push_back(std::string(xml).replace(at, length, text));
  };
  static const std::regex value("<(float|rgb|boolean|string) name='([a-z_]+)' value='([^']*)'/>");
  for (std::sregex_iterator it(xml.begin(), xml.end(), value), end; it != end; ++it) {
    const std::string type = (*it)[1], old = (*it)[3];
    const auto at = static_cast<std::size_t>(it->position(3));
    if (type == "boolean") with(at, old.size(), old == "true" ? "false" : "true");
    if (type == "string") with(at, old.size(), old == "ggx" ? "beckmann" : old == "beckmann" ? "ggx" : "acetone");
    if (type == "boolean" || type == "string") continue;
    static const std::regex number("[0-9.]+");
    for (std::sregex_iterator channel(old.begin(), old.end(), number); channel != end; ++channel) {
      const double x = std::stod(channel->str());
      with(at + static_cast<std::size_t>(channel->position()), channel->str().size(),
           std::to_string(x == 0 ? 0.05 : 1.05 * x));
    }
  }
  for (const auto& [a, b] : std::initializer_list<std::pair<std::string, std::string>>{
           {"'alpha_u'", "'alpha_v'"},
           {"'int_ior'", "'ext_ior'"},
           {"'eta'", "'k'"},
           {"'specular_reflectance'", "'specular_transmittance'"},
           {"'specular_reflectance'", "'diffuse_reflectance'"}}) {
    const std::size_t at_a = xml.find(a), at_b = xml.find(b);
    if (at_a == std::string::npos || at_b == std::string::npos) continue;
    std::string swapped = xml;
    swapped.replace(std::max(at_a, at_b), at_a > at_b ? a.size() : b.size(), at_a > at_b ? b : a);
    swapped.replace(std::min(at_a, at_b), at_a > at_b ? b.size() : a.size(), at_a > at_b ? a : b);
    all.push_back(swapped);
  }
  return all;
}

/// The XML with every default that has an effect written out, so that it can be wrong too.
std::string spelled_out(const std::string& xml) {
  const auto number = [](const char* name, const char* value) {
    return "<float name='" + std::string(name) + "' value='" + value + "'/>";
  };
  const auto grey = [](const char* name, const std::string& value) {
    return "<rgb name='" + std::string(name) + "' value='" + value + ", " + value + ", " + value + "'/>";
  };
  const std::string air = number("ext_ior", "1.000277"), glass = number("int_ior", "1.5046") + air,
                    plastic = number("int_ior", "1.49") + air + grey("diffuse_reflectance", "0.5") +
                              "<boolean name='nonlinear' value='false'/>",
                    rough = "<string name='distribution' value='beckmann'/>" + number("alpha", "0.1");
  const std::string visible = "<boolean name='sample_visible' value='true'/>", diffuse = grey("reflectance", "0.5");
  const std::pair<std::string, std::string> defaults[] = {
      {"diffuse", diffuse},
      {"roughconductor", rough + visible},
      {"dielectric", glass},
      {"thindielectric", glass},
      {"roughdielectric", rough + visible + glass},
      {"plastic", plastic},
      {"roughplastic", rough + plastic},
      {"principled", grey("base_color", "0.5") + number("roughness", "0.5") + number("anisotropic", "0") +
                         number("metallic", "0") + number("spec_trans", "0") + number("specular", "0.5") +
                         number("spec_tint", "0") + number("sheen", "0") + number("flatness", "0") +
                         number("clearcoat", "0") + number("diffuse_reflectance_sampling_rate", "1") +
                         number("main_specular_sampling_rate", "1")},
      {"principledthin", grey("base_color", "0.5") + number("roughness", "0.5") + number("spec_trans", "0") +
                             number("sheen", "0") + number("flatness", "0") + number("diff_trans", "0")},
      {"phong", number("exponent", "30") + grey("diffuse_reflectance", "0.5") + grey("specular_reflectance", "0.2")}};
  const auto element = [](const std::string& kind, const std::string& inside) {
    return "<bsdf type='" + kind + "'>" + inside + "</bsdf>";
  };
  for (const auto& [kind, text] : defaults)
    if (xml == element(kind, "")) return element(kind, text);
  if (xml == element("layered", element("diffuse", ""))) return element("layered", glass + element("diffuse", diffuse));
  return xml;
}

TEST(bsdf_oracle, every_parameter_is_seen) {
  std::size_t seen = 0, with_defaults = 0;
  for (Case a_case : read_cases()) {
    const std::string given = std::exchange(a_case.xml, spelled_out(a_case.xml));
    with_defaults += given != a_case.xml;
    EXPECT_EQ(disagreements(a_case, compile(a_case.xml).record, false), "") << a_case.xml;
    // A metal of index 0 + i k reflects all light, whatever k.
    if (a_case.xml.find("'k'") != std::string::npos && a_case.xml.find("'eta'") == std::string::npos) continue;
    for (const std::string& wrong : wrong_ones(a_case.xml)) {
      ++seen;
      try {
        EXPECT_NE(disagreements(a_case, compile(wrong).record, false), "") << wrong << "\n passes for " << a_case.xml;
      } catch (const InputError&) {  // the correct XML does not throw
      }
    }
  }
  EXPECT_GT(seen, 250u);
  EXPECT_EQ(with_defaults, 11u);
}

/// A texture's value must have the effect that the same value has in the scene. For every parameter that may be a
/// texture, the record with the value in the texture's slot equals, to the bit, that of the scene without a texture.
TEST(bsdf_oracle, textures_are_the_parameters_they_are_named_for) {
  static const std::regex value("<(float|rgb) name='([a-z_]+)' value='([^']*)'/>");
  std::size_t textured = 0;
  for (const Case& a_case : read_cases()) {
    const Bsdf expected = compile(a_case.xml).record;
    for (std::sregex_iterator it(a_case.xml.begin(), a_case.xml.end(), value), end; it != end; ++it) {
      const std::string name = (*it)[2];
      const std::string texture = "<texture type='checkerboard' name='" + name + "'/>";
      CompiledBsdf has;
      try {
        has = compile(
            std::string(a_case.xml)
                .replace(static_cast<std::size_t>(it->position()), static_cast<std::size_t>(it->length()), texture));
      } catch (const InputError&) {
        EXPECT_TRUE(name == "eta" || name == "k" || name == "specular" || name.ends_with("sampling_rate") ||
                    name.ends_with("ior") || name == "sigma_a" || name == "thickness" ||
                    (name == "alpha" && a_case.xml.find("'roughplastic'") != std::string::npos))
            << name;
        continue;
      }
      ++textured;
      const std::string text = std::regex_replace(std::string((*it)[3]), std::regex(","), " ");
      std::vector<float> channels;
      for (const double x : numbers(text)) channels.push_back(static_cast<float>(x));
      ASSERT_EQ(has.record.index(), expected.index());
      ASSERT_FALSE(has.slots.empty()) << name;
      EXPECT_EQ(has.slots.size(), name == "alpha" ? 2u : 1u);  // along both tangents
      std::visit(
          [&](auto record) {
            for (const TextureSlot& slot : has.slots) {
              EXPECT_EQ(slot.is_colour, channels.size() == 3) << name;
              std::memcpy(reinterpret_cast<char*>(&record) + slot.word * sizeof(float), channels.data(),
                          channels.size() * sizeof(float));
            }
            const auto& same = std::get<decltype(record)>(expected);
            EXPECT_EQ(std::memcmp(&record, &same, sizeof(record)), 0) << name << " of " << a_case.xml;
          },
          has.record);
    }
  }
  EXPECT_GT(textured, 40u);
}

/// In rendered images too alpha_u is along dp/du: one spot of a turned rectangle and of a sphere, lit by a point. The
/// spot must have the value of eval in the frame of that tangent. Exchanged roughnesses would give less than 3/4 or
/// more than 4/3 of it.
TEST(bsdf_oracle, alpha_u_is_along_dp_du_in_pictures) {
  const auto metal = [](double alpha_u, double alpha_v) {
    return RoughConductorDescription{MicrofacetDistribution::ggx, alpha_u, alpha_v, true, {}, RgbD(0.8)};
  };
  const Vec3f wo = direction({40, 20}, 0), wi = direction({25, 150}, 0);
  const double intensity = 10, distance = 3;
  const auto expected = [&](const BsdfDescription& bsdf) {
    SceneDescription only;
    only.bsdfs.push_back(bsdf);
    return test::eval(compile_bsdf(only, {0}).record, wo, wi).x * wi.z * intensity / (distance * distance);
  };
  const double value = expected({{}, "", metal(0.15, 0.6)}), exchanged = expected({{}, "", metal(0.6, 0.15)});
  EXPECT_GT(std::abs(std::log(exchanged / value)), std::log(4.0 / 3));
  const double turn = 35 * std::numbers::pi / 180;
  const Vec3d along(std::cos(turn), std::sin(turn), 0), across(-std::sin(turn), std::cos(turn), 0), up(0, 0, 1);
  for (const bool sphere : {false, true}) {
    SceneDescription scene;
    const BsdfIndex bsdf = test::add_bsdf(scene, metal(0.15, 0.6));
    if (sphere)
      test::add_shape(scene, SphereDescription{}, {}, bsdf);
    else
      test::add_shape(scene, RectangleDescription{}, Transform::rotate(up, 35), bsdf);
    // u of a sphere runs with the azimuth about z.
    const Vec3d p = sphere ? along : Vec3d(0, 0, 0), normal = sphere ? along : up, tangent = sphere ? across : along;
    const auto world = [&](const Vec3f& v) {
      return tangent * double{v.x} + cross(normal, tangent) * double{v.y} + normal * double{v.z};
    };
    scene.emitters.push_back({{}, "", PointLightDescription{p + world(wi) * distance, RgbD(intensity)}});
    test::set_camera(scene, Transform::look_at(p + world(wo) * 5.0, p, {0.1, 0.2, 1}), 0.01, 2);
    for (const char* integrator : {"path", "volpath"})
      EXPECT_NEAR(test::image_mean(test::render(scene, integrator, test::job_with(4)).image.mean) / value, 1, 3e-3)
          << integrator << (sphere ? " sphere" : " rectangle");
  }
}

/// Reflectance of metals at normal incidence, linear RGB. Source: Akenine-Moeller et al., Real-Time Rendering, 4th
/// edition, table 9.2 (gold's red, 1.022, is out of the gamut). The table has the colour of the measured reflectance;
/// ours is the reflectance of the colours of eta and k, as in Mitsuba's rgb variants. They differ by 6 % at most.
/// Exchanged channels, eta for k or one metal for another differ by more.
TEST(bsdf_oracle, named_metals_have_their_published_colour) {
  const struct {
    const char* material;
    double published[3];
  } metals[] = {{"Au", {1.000, 0.782, 0.344}}, {"Cu", {0.955, 0.638, 0.538}},       {"Ag", {0.972, 0.960, 0.915}},
                {"Al", {0.913, 0.922, 0.924}}, {"Cu_palik", {0.955, 0.638, 0.538}}, {"Hg", {0.781, 0.780, 0.778}}};
  for (const auto& [material, published] : metals)
    for (const std::string type : {"conductor", "layered"}) {
      const std::string metal =
          "<bsdf type='conductor'><string name='material' value='" + std::string(material) + "'/></bsdf>";
      // A lacquer of the index of air is none.
      const std::string lacquer =
          "<bsdf type='layered'><float name='int_ior' value='1'/><float name='ext_ior' value='1'/>";
      const Bsdf bsdf = compile(type == "conductor" ? metal : lacquer + metal + "</bsdf>").record;
      const auto drawn = test::sample(bsdf, {0, 0, 1}, 0, {0.5f, 0.5f}, TransportMode::radiance);
      ASSERT_TRUE(drawn.has_value());
      const float has[] = {drawn->weight.x, drawn->weight.y, drawn->weight.z};
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(has[c] / published[c], 1, 0.06) << type << " " << material << " " << c;
    }
}

/// Indices by name, from Hecht, Optics, table 4.1 and Lide, CRC Handbook of Chemistry and Physics, at the sodium line.
/// Mitsuba's bk7 is 1.5046 instead of Schott's n_d = 1.5168. Scenes made for Mitsuba need its number, so this test
/// omits bk7.
TEST(bsdf_oracle, named_indices_are_those_of_the_substances) {
  const struct {
    const char* name;
    double published, tolerance;
  } substances[] = {{"vacuum", 1, 0},
                    {"air", 1.000293, 2e-5},
                    {"helium", 1.000036, 1e-6},
                    {"hydrogen", 1.000132, 8e-6},
                    {"carbon dioxide", 1.00045, 1e-6},
                    {"water ice", 1.309, 2e-3},
                    {"water", 1.333, 1e-3},
                    {"ethanol", 1.361, 1e-3},
                    {"acetone", 1.359, 2e-3},
                    {"fused quartz", 1.458, 1e-3},
                    {"glycerol", 1.473, 1e-3},
                    {"carbon tetrachloride", 1.461, 1e-3},
                    {"benzene", 1.501, 1e-3},
                    {"sodium chloride", 1.544, 1e-3},
                    {"bromine", 1.661, 1e-3},
                    {"diamond", 2.417, 3e-3},
                    {"polypropylene", 1.49, 1e-3},
                    {"pyrex", 1.47, 5e-3},
                    {"acrylic glass", 1.491, 2e-3},
                    {"silicone oil", 1.52045, 1e-4},
                    {"amber", 1.55, 1e-2},
                    {"pet", 1.575, 1e-3}};
  EXPECT_EQ(std::size(substances) + 1, ior_names().size());
  for (const auto& [name, published, tolerance] : substances)
    EXPECT_NEAR(ior_named(name).value_or(0), published, tolerance) << name;
  EXPECT_EQ(ior_named("bk7"), 1.5046);
}

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
