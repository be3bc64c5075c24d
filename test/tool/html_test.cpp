// SPDX-License-Identifier: BSD-3-Clause
#include "html/histogram.h"
#include "html/html_text.h"
#include "html/mesh_measures.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace pds
{
namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(HtmlText, escapes_what_html_gives_a_meaning)
{
  EXPECT_EQ(escape_html("<script>\"a\" & 'b'</script>"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;");
  EXPECT_EQ(escape_html("Näpfe.ply"), "Näpfe.ply");
}

TEST(HtmlText, writes_the_examples_of_rfc_4648_in_base64)
{
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64("\xff\xfe"), "//4=");
}

TEST(HtmlText, fills_a_template_once)
{
  EXPECT_EQ(fill_template("<b>{{a}}</b>{{b}}{{a}}", {{"a", "{{b}}"}, {"b", "2"}}), "<b>{{b}}</b>2{{b}}");
  EXPECT_EQ(fill_template("{ }", {}), "{ }");
  EXPECT_THROW(static_cast<void>(fill_template("{{c}}", {})), std::out_of_range);
}

TEST(Histogram, counts_every_finite_value_once)
{
  const Histogram histogram = make_histogram({0, 0.5, 1, 1.5, 2, -0.1, 2.1, nan}, 0, 2, 2);
  EXPECT_EQ(histogram.counts, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(histogram.outside, 2U);
}

TEST(Histogram, is_summed_up)
{
  std::vector<double> values = {nan};
  for (int i = 100; i > 0; --i) {
    values.push_back(i);
  }
  const ValueSummary summary = summarize(values);
  EXPECT_EQ(summary.count, 100U);
  EXPECT_EQ(summary.min, 1);
  EXPECT_EQ(summary.median, 50);
  EXPECT_EQ(summary.p95, 95);
  EXPECT_EQ(summary.max, 100);
  EXPECT_NEAR(summary.mean, 50.5, 1e-12);
  EXPECT_EQ(percentile(values, 0.999), 100);
  EXPECT_EQ(percentile({nan}, 0.5), 0);
  EXPECT_EQ(summarize({}).max, 0);
}

TEST(Histogram, has_round_marks_within_its_range)
{
  EXPECT_EQ(axis_marks(0, 60), (std::vector<double>{0, 10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(axis_marks(-2, 2), (std::vector<double>{-2, -1, 0, 1, 2}));
  EXPECT_EQ(axis_marks(1, 1), std::vector<double>{1});
  for (const double size : {1e-300, 3e-7, 0.07, 1.0, 1e9}) {
    const std::vector<double> marks = axis_marks(0.3 * size, 1.7 * size);
    EXPECT_GE(marks.size(), 3U) << size;
    EXPECT_LE(marks.size(), 7U) << size;
    EXPECT_GE(marks.front(), 0.3 * size * (1 - 1e-6));
    EXPECT_LE(marks.back(), 1.7 * size * (1 + 1e-6));
  }
}

TEST(Histogram, is_drawn_with_a_bar_for_each_bin_the_fullest_of_all_the_height)
{
  const std::string svg = to_svg(make_histogram({0.5, 1.5, 1.6}, 0, 2, 2), "a <b>", "");
  EXPECT_NE(svg.find("aria-label=\"a &lt;b&gt;\""), std::string::npos);
  EXPECT_NE(svg.find("y=\"75.00\" width=\"216.00\" height=\"75.00\"><title>0 to 1: 1</title>"), std::string::npos)
      << svg;
  EXPECT_NE(svg.find("y=\"0.00\" width=\"216.00\" height=\"150.00\"><title>1 to 2: 2</title>"), std::string::npos)
      << svg;
}

TEST(MeshMeasures, of_a_square_of_two_triangles)
{
  const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  std::vector<double> lengths = edge_lengths(square);
  std::sort(lengths.begin(), lengths.end());
  ASSERT_EQ(lengths.size(), 5U) << "the diagonal once";
  EXPECT_EQ(lengths[3], 1);
  EXPECT_NEAR(lengths[4], std::sqrt(2.0), 1e-15);
  for (const double angle : smallest_angles(square)) {
    EXPECT_NEAR(angle, 45, 1e-12);
  }
}

TEST(MeshMeasures, of_the_best_and_the_worst_triangle)
{
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}, {}};
  const std::vector<double> angles = smallest_angles(mesh);
  EXPECT_NEAR(angles[0], 60, 1e-12);
  EXPECT_EQ(angles[1], 0);
}

}  // namespace
}  // namespace pds
