#include "harness/suites/engines.h"

#include "harness/suites/engine_command.h"
#include "scenes/base/shell_text.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_suites {
namespace {

const Engine& builtin(const std::vector<Engine>& engines, const std::string& name) {
  for (const Engine& engine : engines)
    if (engine.name == name) return engine;
  throw std::out_of_range(name);
}

CommandValues example_values() {
  return {.photonproof = "bin/photonproof",
          .suite = "suites",
          .scene = "my scene.xml",
          .output = "o/image.exr",
          .stats = "o/stats.json",
          .scene_name = "my",
          .width = 64,
          .height = 48,
          .threads = 2,
          .seed = 7,
          .budget = {"spp", 16}};
}

std::string error_for(const std::string& row) {
  return input_error_of(
      [&] { engines_from_toml(TomlTable::parse("[[engine]]\n" + row, "s.toml"), builtin_engines()); });
}

constexpr const char* good_row =
    "name = 'mine'\ntitle = 'Mine'\ncommand = ['./mine', '{scene}', '{output}']\nbudgets = ['spp']\ntrust = "
    "'external'\n";

TEST(Engines, builtin_rows_are_our_integrators_other_programs_and_kept_references) {
  const std::vector<Engine> engines = builtin_engines();
  ASSERT_EQ(engines.size(), 10u);
  for (const char* name : {"path", "bdpt", "ptracer", "volpath"}) {
    EXPECT_EQ(builtin(engines, name).trust, Trust::unbiased) << name;
    EXPECT_TRUE(builtin(engines, name).accepts("spp")) << name;
    EXPECT_TRUE(builtin(engines, name).accepts("seconds")) << name;
    EXPECT_FALSE(builtin(engines, name).accepts("photons")) << name;
  }
  EXPECT_EQ(builtin(engines, "photonmapper").trust, Trust::biased);
  EXPECT_EQ(builtin(engines, "sppm").trust, Trust::biased);
  EXPECT_EQ(builtin(engines, "povray").trust, Trust::biased);
  EXPECT_EQ(builtin(engines, "cycles").trust, Trust::unbiased);
  EXPECT_TRUE(builtin(engines, "cycles").accepts("spp"));
  EXPECT_EQ(builtin(engines, "mitsuba").trust, Trust::unbiased);
  EXPECT_TRUE(builtin(engines, "mitsuba").accepts("spp"));
  EXPECT_TRUE(builtin(engines, "photonmapper").accepts("photons"));
  EXPECT_TRUE(builtin(engines, "povray").accepts("quality"));
  EXPECT_TRUE(builtin(engines, "reference").accepts("standard-error"));
}

TEST(Engines, command_of_the_path_tracer_is_as_one_would_type_it) {
  EXPECT_EQ(shell_line(fill_command(builtin(builtin_engines(), "path").command, example_values())),
            "bin/photonproof render 'my scene.xml' --integrator path -o o/image.exr --stats o/stats.json --size 64x48 "
            "--seed 7 --threads 2 --checkpoint 0 --spp 16");
}

TEST(Engines, budget_amounts_are_written_in_full) {
  CommandValues values = example_values();
  values.budget = {"photons", 1e7};
  EXPECT_EQ(fill_command({"{budget}", "n={amount}"}, values),
            (std::vector<std::string>{"--photons", "10000000", "n=10000000"}));
}

TEST(Engines, row_of_a_suite_is_read) {
  const TomlTable document = TomlTable::parse(
      "[[engine]]\n" + std::string(good_row) + "image = 'png'\nversions = [['{suite}/mine', '-v']]", "s.toml");
  const std::vector<Engine> engines = engines_from_toml(document, builtin_engines());
  ASSERT_EQ(engines.size(), 1u);
  EXPECT_EQ(engines[0].name, "mine");
  EXPECT_EQ(engines[0].trust, Trust::external);
  EXPECT_EQ(engines[0].image_extension, "png");
  EXPECT_EQ(fill_command(engines[0].version_commands.at(0), example_values()),
            (std::vector<std::string>{"suites/mine", "-v"}));
  EXPECT_EQ(fill_command(engines[0].command, example_values()),
            (std::vector<std::string>{"suites/mine", "my scene.xml", "o/image.exr"}));
}

TEST(Engines, layer_is_of_an_exr) {
  const TomlTable document =
      TomlTable::parse("[[engine]]\n" + std::string(good_row) + "layer = 'View.Combined'\n", "s.toml");
  EXPECT_EQ(engines_from_toml(document, builtin_engines()).at(0).layer, "View.Combined");
  EXPECT_TRUE(error_for(std::string(good_row) + "image = 'png'\nlayer = 'beauty'\n")
                  .starts_with("s.toml:8:9: error: 'layer' is of an EXR; the engine's 'image' is 'png'"));
}

const std::string denoising_row =
    "name = 'mine'\ntitle = 'Mine'\ncommand = ['{photonproof}', 'render', '{scene}', '-o', '{output}']\n"
    "versions = [['{photonproof}', '--version']]\nbudgets = ['spp']\ntrust = 'biased'\ndenoise = ";

TEST(Engines, row_that_denoises_gets_the_option_the_version_and_its_marks) {
  const auto row = [](const std::string& value) {
    return engines_from_toml(TomlTable::parse("[[engine]]\n" + denoising_row + value, "s.toml"), {}).at(0);
  };
  const Engine denoised = row("true"), plain = row("false");
  EXPECT_TRUE(denoised.denoises);
  EXPECT_EQ(denoised.title, "Mine (denoised, biased)");
  EXPECT_EQ(shell_line(fill_command(denoised.command, example_values())),
            "bin/photonproof render 'my scene.xml' -o o/image.exr --denoise");
  ASSERT_EQ(denoised.version_commands.size(), 2u);
  EXPECT_EQ(shell_line(fill_command(denoised.version_commands[1], example_values())), "bin/photonproof denoiser");
  EXPECT_FALSE(plain.denoises);
  EXPECT_EQ(plain.title, "Mine");
  EXPECT_EQ(plain.version_commands.size(), 1u);
  EXPECT_EQ(plain.command.back(), "{output}");
}

TEST(Engines, row_that_denoises_is_biased_and_of_this_program) {
  const auto changed = [](std::string row, const std::string& old, const std::string& fresh) {
    return error_for(row.replace(row.find(old), old.size(), fresh));
  };
  for (const char* trust : {"unbiased", "external"})
    EXPECT_TRUE(changed(denoising_row + "true", "biased", trust)
                    .starts_with("s.toml:7:9: error: an engine that denoises is biased; 'trust' must be \"biased\""));
  for (const char* command : {"'{photonproof}', 'povray'", "'mine', 'render'"})
    EXPECT_TRUE(changed(denoising_row + "true", "'{photonproof}', 'render'", command)
                    .starts_with("s.toml:8:11: error: 'denoise' is of commands that begin with {photonproof} render"));
  for (const char* value : {"true", "false"})
    EXPECT_TRUE(changed(denoising_row + value, "'-o'", "'--denoise', '-o'")
                    .starts_with("s.toml:4:11: error: write denoise = true in place of --denoise, so that reports and "
                                 "gates know of it"));
}

TEST(Engines, name_that_is_taken_is_refused) {
  EXPECT_EQ(error_for("name = 'path'\n" + std::string(good_row).substr(std::string("name = 'mine'\n").size())),
            "s.toml:2:8: error: there is an engine 'path' already\n  name = 'path'\n         ^");
}

TEST(Engines, name_that_cannot_be_a_file_name_is_refused) {
  EXPECT_TRUE(error_for("name = '../x'\n")
                  .starts_with("s.toml:2:8: error: 'name' may hold letters, digits, '_', '.' and '-'; not '../x'"));
}

TEST(Engines, unknown_trust_is_refused) {
  std::string row = good_row;
  row.replace(row.find("external"), 8, "blind");
  EXPECT_TRUE(
      error_for(row).starts_with("s.toml:6:9: error: 'trust' is one of unbiased, biased, external; not 'blind'"))
      << error_for(row);
}

TEST(Engines, unknown_key_of_a_row_is_refused) {
  EXPECT_TRUE(error_for(std::string(good_row) + "colour = 1").starts_with("s.toml:7:1: error: unknown key 'colour'"));
}

TEST(Engines, commands_that_cannot_work_are_refused) {
  const auto problem = [](const std::vector<std::string>& command) {
    return command_problem(command, CommandUse::render).value_or("fine");
  };
  EXPECT_EQ(problem({"x", "{scene}", "{output}"}), "fine");
  EXPECT_EQ(problem({}), "a command needs at least a program");
  EXPECT_EQ(problem({"x", "{scene}"}), "the command does not mention {output}");
  EXPECT_EQ(problem({"x", "{output}"}), "the command does not mention {scene} or {scene_name}");
  EXPECT_EQ(
      problem({"x", "{scne}"}),
      "'{scne}' has an unknown placeholder (did you mean 'scene'?); known: {budget} {photonproof} {suite} {scene} "
      "{scene_name} {output} {stats} {width} {height} {threads} {seed} {amount}");
  EXPECT_EQ(problem({"x", "{scene"}).substr(0, 35), "'{scene' has an unknown placeholder");
  EXPECT_EQ(problem({"x", "-b{budget}"}), "{budget} becomes two arguments and must stand alone, not in '-b{budget}'");
}

TEST(Engines, relative_programs_start_from_the_suites_folder_and_names_from_path) {
  CommandValues values = example_values();
  const auto program = [&](const std::string& name) { return fill_command({name}, values).front(); };
  EXPECT_EQ(program("build/mine"), "suites/build/mine");
  EXPECT_EQ(program("../mine"), "./mine");  // so that no program on PATH is taken
  EXPECT_EQ(program("mine"), "mine");
  EXPECT_EQ(program("/bin/mine"), "/bin/mine");
  EXPECT_EQ(program("{suite}/mine"), "suites/mine");
  values.suite = ".";
  EXPECT_EQ(program("./mine"), "./mine");
  EXPECT_EQ(program("build/mine"), "build/mine");
}

TEST(Engines, version_commands_know_no_scene) {
  EXPECT_EQ(command_problem({"x", "{scene}"}, CommandUse::version).value_or("fine"),
            "'{scene}' has an unknown placeholder; known: {photonproof} {suite}");
  EXPECT_FALSE(command_problem({"{photonproof}", "--version"}, CommandUse::version).has_value());
}

}  // namespace
}  // namespace photonproof::inline harness_suites
