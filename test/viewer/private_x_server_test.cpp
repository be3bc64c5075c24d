// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/private_x_server.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace pds
{
namespace
{

TEST(PrivateXServer, IsStartedAndEnded)
{
  std::string display;
  unsetenv("DISPLAY");
  {
    const PrivateXServer server;
    ASSERT_NE(std::getenv("DISPLAY"), nullptr);
    display = std::getenv("DISPLAY");
    const PrivateXServer second;  // takes the first one's display
    EXPECT_EQ(std::getenv("DISPLAY"), display);
  }
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
}

TEST(PrivateXServer, SaysWhatIsMissing)
{
  unsetenv("DISPLAY");
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  try {
    const PrivateXServer server;
    ADD_FAILURE() << "found an Xvfb nowhere";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("install xvfb"), std::string::npos) << error.what();
  }
  setenv("PATH", path.c_str(), 1);
}

TEST(PrivateXServer, SaysThatADisplayDoesNotAnswer)
{
  setenv("DISPLAY", ":9999", 1);
  try {
    const PrivateXServer server;
    ADD_FAILURE() << "reached a server that is not there";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no X server answers at DISPLAY :9999"), std::string::npos);
  }
  unsetenv("DISPLAY");
}

}  // namespace
}  // namespace pds
