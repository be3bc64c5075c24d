// SPDX-License-Identifier: BSD-3-Clause
// Starts the tool as a user does, presses its keys through the X server and looks at the screen.
#include "tool/run_testing.h"
#include "viewer/private_x_server.h"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <thread>

// After all else: it defines None, Bool and other words.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>

namespace pds
{
namespace
{

constexpr int side = 300;  // of the window, pixels

bool is_drawn(int red, int green, int blue) { return red + green + blue < 3 * 250; }
/** \brief Warm grey; points are of a cold one, and a new window is black. */
bool is_mesh(int red, int green, int blue) { return red > blue && red < green + 20 && red > 50; }
bool is_seed(int red, int green, int blue) { return red > 200 && green < 60 && blue < 60; }
bool is_mark(int red, int green, int blue) { return red > 200 && green < 40 && blue > 180; }

class RealWindow : public TemporaryDirectory
{
 protected:
  ~RealWindow() override
  {
    if (display_ != nullptr) XCloseDisplay(display_);
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
  }

  void start(const std::string& file)
  {
    display_ = XOpenDisplay(nullptr);
    ASSERT_NE(display_, nullptr);
    process_ = fork();
    if (process_ == 0) {
      dup2(open(path("log").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      execl(TOOL, TOOL, "--size", "300x300", path(file).c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    ASSERT_TRUE(wait_until([this] { return (window_ = find_window(DefaultRootWindow(display_))) != 0; }))
        << read("log");
  }

  /** \brief Tries until it is so. \return false if that takes forever */
  template <typename Condition>
  static bool wait_until(const Condition& condition)
  {
    constexpr int forever = 3000;
    for (int i = 0; i < forever; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  void press(KeySym key, unsigned modifiers = 0)
  {
    XKeyEvent event{};
    event.type = KeyPress;
    event.display = display_;
    event.window = window_;
    event.root = DefaultRootWindow(display_);
    event.x = event.y = side / 2;
    event.same_screen = True;
    event.keycode = XKeysymToKeycode(display_, key);
    event.state = modifiers;
    XSendEvent(display_, window_, True, KeyPressMask, reinterpret_cast<XEvent*>(&event));
    XFlush(display_);
  }

  /** \brief Pixels of a kind above the line of text. */
  std::size_t count(bool (*is_wanted)(int red, int green, int blue))
  {
    constexpr int text_height = 40;
    XImage* image = XGetImage(display_, window_, 0, 0, side, side - text_height, AllPlanes, ZPixmap);
    std::size_t found = 0;
    for (int y = 0; y < image->height; ++y)
      for (int x = 0; x < image->width; ++x) {
        const auto pixel = static_cast<unsigned>(XGetPixel(image, x, y));
        found += is_wanted(static_cast<int>(pixel >> 16 & 255), static_cast<int>(pixel >> 8 & 255),
                           static_cast<int>(pixel & 255))
                     ? 1
                     : 0;
      }
    XDestroyImage(image);
    return found;
  }

  bool has_ended()
  {
    const bool ended = waitpid(process_, &status_, WNOHANG) == process_;
    if (ended) process_ = 0;
    return ended;
  }

  int status_ = -1;

 private:
  /** \brief The tool's window once it is on the screen, 0 before. */
  Window find_window(Window parent)
  {
    Window root = 0;
    Window above = 0;
    Window* children = nullptr;
    unsigned count = 0;
    XQueryTree(display_, parent, &root, &above, &children, &count);
    Window found = 0;
    for (unsigned i = 0; i < count && found == 0; ++i) {
      char* name = nullptr;
      XWindowAttributes attributes;
      const bool is_ours = XFetchName(display_, children[i], &name) != 0 && std::string(name) == "pcl_pds_viewer";
      if (name != nullptr) XFree(name);
      if (is_ours && XGetWindowAttributes(display_, children[i], &attributes) != 0 &&
          attributes.map_state == IsViewable)
        found = children[i];
    }
    if (children != nullptr) XFree(children);
    return found;
  }

  PrivateXServer server_;
  Display* display_ = nullptr;
  Window window_ = 0;
  pid_t process_ = 0;
};

TEST_F(RealWindow, draws_reconstructs_and_obeys_its_keys)
{
  write("cloud.xyz", sphere_rows(20000, 1, 0, 0));
  start("cloud.xyz");
  ASSERT_TRUE(wait_until([this] { return count(is_mesh) > 20000; })) << read("log");

  press(XK_s);
  EXPECT_TRUE(wait_until([this] { return count(is_seed) > 300; }));
  press(XK_s);
  EXPECT_TRUE(wait_until([this] { return count(is_seed) == 0; }));
  press(XK_p);
  EXPECT_TRUE(wait_until([this] { return count(is_mark) > 20; }));

  press(XK_m);
  EXPECT_TRUE(wait_until([this] { return count(is_drawn) < 200; }));  // the mark is still there
  press(XK_e);
  ASSERT_TRUE(wait_until([this] { return count(is_drawn) > 5000; }));
  const std::size_t edges = count(is_drawn);
  for (int i = 0; i < 4; ++i) press(XK_plus, ShiftMask);
  EXPECT_TRUE(wait_until([this, edges] { return count(is_drawn) < edges / 2; })) << "wider meshes have fewer edges";

  press(XK_q);
  ASSERT_TRUE(wait_until([this] { return has_ended(); }));
  EXPECT_TRUE(WIFEXITED(status_) && WEXITSTATUS(status_) == 0) << status_;
  EXPECT_EQ(read("log"), "");
}

}  // namespace
}  // namespace pds
