/* edgewalk: a cycle-level, bit-accurate model of scan-line triangle hardware.
 *
 * Written by cbindgen from crates/capi; docs/c.md has an example.
 *
 * A call that can fail returns a code: EDGEWALK_CODE_OK is 0. edgewalk_message() says what was wrong. Nothing is given
 * then, and nothing is changed. A pointer given to a call must be valid: an object of this library that was not freed,
 * a text that ends with a zero byte, an array with as many elements as are said. Where NULL is permitted, it is said;
 * elsewhere NULL is an error. An object may be used by one thread at a time. */


#ifndef EDGEWALK_H
#define EDGEWALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// How a call ended.
typedef enum EdgewalkCode {
  // As asked.
  EDGEWALK_CODE_OK = 0,
  // NULL, a text that is not UTF-8, or an array of the wrong length.
  EDGEWALK_CODE_ARGUMENT = 1,
  // A machine that cannot be built.
  EDGEWALK_CODE_MACHINE = 2,
  // A frame that cannot be read, or that the machine cannot draw.
  EDGEWALK_CODE_FRAME = 3,
  // A port that the machine has not, or a word that the port has not.
  EDGEWALK_CODE_PORT = 4,
  // A defect of edgewalk.
  EDGEWALK_CODE_DEFECT = 5,
} EdgewalkCode;

// Triangles and rules for a machine, as the lines of a triangle file.
typedef struct EdgewalkFrame EdgewalkFrame;

// A checked machine. It never changes.
typedef struct EdgewalkMachine EdgewalkMachine;

// A machine that draws a frame clock by clock, with its memories. They never make it wait.
typedef struct EdgewalkRun EdgewalkRun;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Returns the error message of the last failed call in this thread. The message names the fault, the permitted
// values and the remedy. The message is empty before the first failure. The pointer is valid until the next call in
// this thread that fails.
const char *edgewalk_message(void);

// The version of the library, as in `0.1.0`.
const char *edgewalk_version(void);

// The machine of this preset, as `default` or `small`.
enum EdgewalkCode edgewalk_machine_preset(const char *name, struct EdgewalkMachine **machine);

// The machine of a machine file's text. Keys that are left out have the values of the preset `default`, or of the one
// that the text names: `preset = "small"`.
enum EdgewalkCode edgewalk_machine_toml(const char *toml, struct EdgewalkMachine **machine);

// Columns of the screen; 0 of NULL.
uint32_t edgewalk_machine_width(const struct EdgewalkMachine *machine);

// Lines of the screen; 0 of NULL.
uint32_t edgewalk_machine_height(const struct EdgewalkMachine *machine);

// Frees a machine; NULL is permitted. Frames of the machine are not touched.
void edgewalk_machine_free(struct EdgewalkMachine *machine);

// An empty frame on the machine's screen.
enum EdgewalkCode edgewalk_frame_new(const struct EdgewalkMachine *machine, struct EdgewalkFrame **frame);

// Appends lines of a triangle file (docs/triangle_file.md), such as "depth lequal": rules, triangles, lines, polygons.
// The file's first line, size, is there already. Mistakes are found when the frame is drawn.
enum EdgewalkCode edgewalk_frame_lines(struct EdgewalkFrame *frame,
                                       const char *lines);

// Appends a triangle: of each vertex x and y in pixels, y down; z, r, g, b and k_t, its transparency, in 0 to 1. These
// are 21 numbers. Mistakes are found when the frame is drawn.
enum EdgewalkCode edgewalk_frame_triangle(struct EdgewalkFrame *frame,
                                          const double *vertices);

// Frees a frame; NULL is permitted. Runs of the frame are not touched.
void edgewalk_frame_free(struct EdgewalkFrame *frame);

// Draws a frame with a memory that never makes the machine wait. Arrays have an element for each pixel, line by line
// from the top: `z` the stored depth in LSB; `rgb` three stored colours in LSB; `id` the place in the frame of the
// triangle that was written last, or -1. `pixels` is width times height. `cycles` is what the machine needs. What is
// not wanted may be NULL.
enum EdgewalkCode edgewalk_draw(const struct EdgewalkFrame *frame,
                                uint32_t *z,
                                uint32_t *rgb,
                                int32_t *id,
                                size_t pixels,
                                uint64_t *cycles);

// A run of the frame as it is now, before its first clock. The frame has one state (docs/triangle_file.md), no light's
// map and no shading at each pixel.
enum EdgewalkCode edgewalk_run_new(const struct EdgewalkFrame *frame,
                                   struct EdgewalkRun **run);

// One clock. Afterwards `edgewalk_run_port` gives the values of the clock, as they stood before its rising edge. The
// first clock is the first without reset.
enum EdgewalkCode edgewalk_run_tick(struct EdgewalkRun *run);

// Whether all triangles are drawn and the machine was idle in the last clock. NULL is done.
bool edgewalk_run_is_done(const struct EdgewalkRun *run);

// Clocks so far; 0 of NULL.
uint64_t edgewalk_run_clocks(const struct EdgewalkRun *run);

// The value of a port in the last clock, by its name in docs/machine.md, section 20, such as "wr_addr". `word` 0 has
// bits 63 to 0, `word` 1 bits 127 to 64 of a wider port. A signed value is not extended. Fields count while their
// valid is 1.
enum EdgewalkCode edgewalk_run_port(const struct EdgewalkRun *run, const char *port, uint32_t word, uint64_t *value);

// Frees a run; NULL is permitted.
void edgewalk_run_free(struct EdgewalkRun *run);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* EDGEWALK_H */
