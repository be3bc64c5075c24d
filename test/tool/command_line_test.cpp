// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include "option_table.h"
#include "temporary_directory.h"

namespace pds
{
namespace
{

CommandLine parse(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "pcl_pds_recon");
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(argument.c_str());
  }
  return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

CommandLine parse_with_files(std::vector<std::string> arguments)
{
  arguments.insert(arguments.end(), {"in.ply", "out.ply"});
  return parse(arguments);
}

/** What is wrong with the arguments; empty if they are taken. */
std::string complaint(const std::vector<std::string>& arguments)
{
  try {
    parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string complaint_with_files(std::vector<std::string> arguments)
{
  arguments.insert(arguments.end(), {"in.ply", "out.ply"});
  return complaint(arguments);
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Config : public TemporaryDirectory
{
};

TEST(CommandLineTest, defaults_are_those_of_the_contract)
{
  const CommandLine command_line = parse_with_files({});
  EXPECT_EQ(command_line.inputs, std::vector<std::string>{"in.ply"});
  EXPECT_EQ(command_line.output, "out.ply");
  EXPECT_EQ(command_line.options.k_neighbors, 15);
  EXPECT_EQ(command_line.options.radius_factor, 3);
  EXPECT_EQ(command_line.options.radius, 0);
  EXPECT_EQ(command_line.options.adaptive, 0);
  EXPECT_EQ(command_line.options.voronoi_threshold, 0.1);
  EXPECT_EQ(command_line.options.hole_size, 15);
  EXPECT_EQ(command_line.verbosity, Verbosity::normal);
  EXPECT_FALSE(command_line.ascii);
}

TEST(CommandLineTest, takes_short_and_long_names)
{
  const CommandLine a = parse_with_files({"-k", "30", "-f2.5", "-r", "0.5", "-a", "0.25", "-j", "2", "-q"});
  const CommandLine b = parse_with_files(
      {"--k-neighbors=30", "--radius-factor", "2.5", "--radius=5e-1", "--adaptive=.25", "--threads=2", "--quiet"});
  for (const CommandLine& command_line : {a, b}) {
    EXPECT_EQ(command_line.options.k_neighbors, 30);
    EXPECT_EQ(command_line.options.radius_factor, 2.5);
    EXPECT_EQ(command_line.options.radius, 0.5);
    EXPECT_EQ(command_line.options.adaptive, 0.25);
    EXPECT_EQ(command_line.options.threads, 2U);
    EXPECT_EQ(command_line.verbosity, Verbosity::quiet);
  }
  const CommandLine c =
      parse_with_files({"--voronoi-threshold", "0.2", "--hole-size", "0", "--seed", "18446744073709551615", "--report",
                        "r.json", "--voronoi", "v.ply", "--ascii", "-v"});
  EXPECT_EQ(c.options.voronoi_threshold, 0.2);
  EXPECT_EQ(c.options.hole_size, 0);
  EXPECT_EQ(c.options.seed, 18446744073709551615U);
  EXPECT_EQ(c.report_file, "r.json");
  EXPECT_EQ(c.voronoi_file, "v.ply");
  EXPECT_TRUE(c.ascii);
  EXPECT_EQ(c.verbosity, Verbosity::detailed);
}

TEST(CommandLineTest, takes_several_inputs_streams_classes_and_normals)
{
  const CommandLine command_line = parse({"a.ply", "b.pcd", "-", "--class", "2,6,255", "--normals", "-"});
  EXPECT_EQ(command_line.inputs, (std::vector<std::string>{"a.ply", "b.pcd", "-"}));
  EXPECT_EQ(command_line.output, "-");
  EXPECT_EQ(output_extension(command_line), ".ply");
  EXPECT_EQ(command_line.classes, (std::vector<std::uint8_t>{2, 6, 255}));
  EXPECT_TRUE(command_line.normals);
  EXPECT_TRUE(parse_with_files({}).classes.empty());
  EXPECT_FALSE(parse_with_files({}).normals);
  for (const char* bad : {"", ",", "2,,6", "2,", "2;6", "256", "-1", "2.5", "ground"}) {
    EXPECT_TRUE(contains(complaint_with_files({std::string("--class=") + bad}), "--class")) << bad;
  }
  EXPECT_TRUE(contains(complaint({"a.ply", "a.ply", "out.ply"}), "named twice"));
  EXPECT_TRUE(contains(complaint({"a.ply", "out_1.ply", "out.ply", "--levels", "2"}), "named twice"));
  EXPECT_TRUE(contains(complaint({"a.ply", "-", "--levels", "2"}), "standard output"));
  EXPECT_TRUE(contains(complaint_with_files({"--levels", "2", "--relax", "1"}), "exclude each other"));
  EXPECT_TRUE(contains(complaint_with_files({"-n", "100", "--max-error", "1"}), "exclude each other"));
}

TEST(CommandLineTest, names_the_option_that_is_no_number)
{
  for (const char* bad : {"3x", "abc", "", "0x10", "1,5", "nan", "inf", "-nan", "1e999", " 5"}) {
    for (const char* option : {"--k-neighbors", "--radius-factor", "--radius", "--adaptive", "--voronoi-threshold",
                               "--hole-size", "--threads", "--seed"}) {
      EXPECT_TRUE(contains(complaint_with_files({std::string(option) + "=" + bad}), option)) << option << '=' << bad;
    }
  }
  EXPECT_TRUE(contains(complaint_with_files({"-k", "3x"}), "--k-neighbors"));
  EXPECT_TRUE(contains(complaint_with_files({"-k", "15.5"}), "--k-neighbors"));
  EXPECT_TRUE(contains(complaint_with_files({"--placement", "middle"}), "--placement: 'middle' does not fit"));
  EXPECT_TRUE(contains(complaint_with_files({"--dimension", "3"}), "--dimension: '3' does not fit: "));
}

TEST(CommandLineTest, takes_dimensions)
{
  EXPECT_EQ(parse_with_files({}).options.dimension, Dimension::surface);
  EXPECT_EQ(parse_with_files({"--dimension", "1"}).options.dimension, Dimension::curve);
  EXPECT_EQ(parse_with_files({"--dimension", "2"}).options.dimension, Dimension::surface);
  EXPECT_EQ(parse_with_files({"--dimension=auto"}).options.dimension, Dimension::automatic);
}

TEST(CommandLineTest, refuses_with_curves_what_is_about_triangles)
{
  const std::vector<std::vector<std::string>> refused = {
      {"--vertices", "100"},      {"--max-error", "1"}, {"--adaptive", "0.3"}, {"--relax", "2"},
      {"--placement", "quadric"}, {"--levels", "2"},    {"--normals"},         {"--html", "page.html"}};
  for (const char* dimension : {"1", "auto"}) {
    for (std::vector<std::string> arguments : refused) {
      const std::string name = arguments.front();
      arguments.insert(arguments.end(), {"--dimension", dimension});
      EXPECT_TRUE(contains(complaint_with_files(arguments), name)) << name << " with " << dimension;
    }
    EXPECT_TRUE(contains(complaint({"in.ply", "out.stl", "--dimension", dimension}), "'.stl' holds triangles only"));
  }
}

TEST(CommandLineTest, names_the_option_out_of_range)
{
  const std::vector<std::pair<std::string, std::vector<std::string>>> rejected = {
      {"--k-neighbors", {"3", "201", "-1", "99999999999"}},
      {"--radius-factor", {"1.4", "1001", "-3"}},
      {"--radius", {"-1"}},
      {"--adaptive", {"-0.1", "2.1"}},
      {"--voronoi-threshold", {"-0.1", "1.1"}},
      {"--hole-size", {"-1"}},
      {"--vertices", {"3", "-1", "4294967296"}},
      {"--max-error", {"-1"}},
      {"--relax", {"101", "-1"}},
      {"--levels", {"0", "17", "-1"}},
      {"--threads", {"-1"}},
      {"--seed", {"-1", "18446744073709551616"}}};
  for (const auto& [option, values] : rejected) {
    for (const std::string& value : values) {
      EXPECT_EQ(complaint_with_files({option, value}).rfind(option, 0), 0U) << option << ' ' << value;
    }
  }
  EXPECT_TRUE(contains(complaint_with_files({"-k", "3"}), "4 to 200"));
}

TEST(CommandLineTest, rejects_what_it_does_not_know)
{
  EXPECT_TRUE(contains(complaint_with_files({"--bogus"}), "bogus"));
  EXPECT_TRUE(contains(complaint_with_files({"--rad", "1"}), "rad")) << "an abbreviation";
  EXPECT_TRUE(contains(complaint_with_files({"-k", "9", "-k", "10"}), "k-neighbors")) << "given twice";
  EXPECT_TRUE(contains(complaint_with_files({"-q", "-v"}), "-q and -v"));
  EXPECT_TRUE(contains(complaint({"in.ply"}), "OUTPUT"));
  EXPECT_TRUE(contains(complaint({}), "INPUT"));
  EXPECT_TRUE(contains(complaint({"in.ply", "out.ply", "-k"}), "k-neighbors"));
}

TEST(CommandLineTest, checks_the_names_of_outputs)
{
  EXPECT_TRUE(contains(complaint({"in.ply", "out.xyz"}), "'.xyz'"));
  EXPECT_TRUE(contains(complaint({"in.ply", "out"}), ".ply"));
  EXPECT_EQ(complaint({"in.ply", "OUT.PLY"}), "");
  EXPECT_TRUE(contains(complaint_with_files({"--voronoi", "v.obj"}), "--voronoi"));
  EXPECT_TRUE(contains(complaint({"a.ply", "./a.ply"}), "named twice"));
  EXPECT_TRUE(contains(complaint_with_files({"--voronoi", "out.ply"}), "named twice"));
  EXPECT_TRUE(contains(complaint_with_files({"--report", "r", "--save-config", "r"}), "named twice"));
}

TEST(CommandLineTest, help_lists_every_option)
{
  const std::string help = parse({"-h"}).information;
  EXPECT_EQ(help.rfind("Usage: pcl_pds_recon", 0), 0U);
  for (const OptionRow& row : option_table()) {
    EXPECT_TRUE(contains(help, "--" + row.name)) << row.name;
  }
  EXPECT_TRUE(contains(help, "--config"));
  EXPECT_TRUE(contains(help, "Exit status:"));
  EXPECT_EQ(parse({"--version"}).information.rfind("pcl_pds_recon ", 0), 0U);
}

TEST_F(Config, round_trip_gives_the_same_run)
{
  const CommandLine saved = parse_with_files({"-k",
                                              "31",
                                              "-f",
                                              "2.3000000000000003",
                                              "-r",
                                              "1e-7",
                                              "-a",
                                              "0.1",
                                              "--voronoi-threshold",
                                              "0.3",
                                              "--hole-size",
                                              "7",
                                              "-j",
                                              "3",
                                              "--seed",
                                              "9",
                                              "-n",
                                              "1234",
                                              "--levels",
                                              "3",
                                              "--placement",
                                              "quadric",
                                              "--dimension",
                                              "2",
                                              "--class",
                                              "2,6",
                                              "--normals",
                                              "--ascii",
                                              "--report",
                                              "my report.json",
                                              "--voronoi",
                                              "v.ply",
                                              "-v"});
  const std::string file = write("run.ini", to_config(saved));
  const CommandLine loaded = parse_with_files({"--config", file});
  EXPECT_EQ(to_config(loaded), to_config(saved));
  EXPECT_EQ(loaded.options.radius_factor, 2.3000000000000003);
  EXPECT_EQ(loaded.options.radius, 1e-7);
  EXPECT_EQ(loaded.options.placement, Placement::quadric);
  EXPECT_EQ(loaded.options.vertices, 1234U);
  EXPECT_EQ(loaded.levels, 3U);
  EXPECT_EQ(loaded.report_file, "my report.json");
  EXPECT_EQ(loaded.classes, saved.classes);
  EXPECT_TRUE(loaded.normals);
  EXPECT_TRUE(loaded.ascii);
  EXPECT_EQ(loaded.verbosity, Verbosity::detailed);

  const CommandLine defaults = parse_with_files({});
  EXPECT_EQ(to_config(parse_with_files({"--config", write("default.ini", to_config(defaults))})), to_config(defaults));
}

TEST_F(Config, command_line_wins)
{
  const std::string file = write("run.ini", "k-neighbors = 30\nradius = 0.5\nquiet = true\n");
  const CommandLine command_line = parse_with_files({"--config", file, "-k", "20", "-v"});
  EXPECT_EQ(command_line.options.k_neighbors, 20);
  EXPECT_EQ(command_line.options.radius, 0.5);
  EXPECT_EQ(command_line.verbosity, Verbosity::detailed);
  EXPECT_EQ(parse_with_files({"--config", file, "-f", "4"}).options.radius, 0) << "-f replaces the file's radius";
}

TEST_F(Config, errors_name_the_file_and_the_option)
{
  const auto of = [this](const std::string& text) {
    return complaint_with_files({"--config", write("bad.ini", text)});
  };
  for (const auto& [text, option] :
       std::vector<std::pair<std::string, std::string>>{{"bogus = 1\n", "bogus"},
                                                        {"[method]\nseed = 1\n", "method.seed"},
                                                        {"config = a.ini\n", "config"},
                                                        {"k-neighbors = 3x\n", "k-neighbors"},
                                                        {"ascii = maybe\n", "ascii"},
                                                        {"seed = 1\nseed = 2\n", "seed"}}) {
    EXPECT_TRUE(contains(of(text), "bad.ini")) << of(text);
    EXPECT_TRUE(contains(of(text), option)) << of(text);
  }
  EXPECT_TRUE(contains(of("k-neighbors = 3\n"), "--k-neighbors"));
  EXPECT_TRUE(contains(complaint_with_files({"--config", path("missing.ini")}), "missing.ini"));
  EXPECT_TRUE(contains(complaint_with_files({"--config", path("")}), "cannot be read"));
}

TEST_F(Config, refuses_to_save_a_name_that_would_not_come_back)
{
  EXPECT_THROW(static_cast<void>(to_config(parse_with_files({"--report", "run#1.json"}))), UsageError);
}

TEST(Presets, are_read_and_hold_the_settings_of_the_paper)
{
  const auto preset = [](const std::string& name) {
    return parse_with_files({"--config", std::string(PRESETS) + "/" + name}).options;
  };
  EXPECT_EQ(preset("hand_uniform.ini").k_neighbors, 30);
  EXPECT_EQ(preset("hand_uniform.ini").adaptive, 0);
  EXPECT_EQ(preset("hand_adaptive.ini").adaptive, 0.25);
  EXPECT_EQ(preset("dragon.ini").adaptive, 0.3);
  EXPECT_EQ(preset("dense_model.ini").radius_factor, 2.3);
  for (const auto& entry : std::filesystem::directory_iterator(PRESETS)) {
    EXPECT_NO_THROW(preset(entry.path().filename().string())) << entry.path();
  }
}

}  // namespace
}  // namespace pds
