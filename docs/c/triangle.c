/* Ticks a triangle and prints every write: address, depth, red, green, blue. */
#include "edgewalk.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static void check(EdgewalkCode code) {
    if (code == EDGEWALK_CODE_OK) return;
    fprintf(stderr, "%s\n", edgewalk_message());
    exit(1);
}

static uint64_t port(const EdgewalkRun *run, const char *name) {
    uint64_t value;
    check(edgewalk_run_port(run, name, 0, &value));
    return value;
}

int main(void) {
    const double triangle[21] = { /* x, y, z, r, g, b, k_t */
        20, 10, 0.5, 1, 0, 0, 0,   90, 30, 0.4, 0, 1, 0, 0,   40, 75, 0.3, 0, 0, 1, 0,
    };
    EdgewalkMachine *machine;
    EdgewalkFrame *frame;
    EdgewalkRun *run;
    check(edgewalk_machine_toml("preset = \"small\"", &machine));
    check(edgewalk_frame_new(machine, &frame));
    check(edgewalk_frame_triangle(frame, triangle));
    check(edgewalk_run_new(frame, &run));
    while (!edgewalk_run_is_done(run)) {
        check(edgewalk_run_tick(run));
        if (port(run, "wr_valid") && port(run, "wr_ready"))
            printf("%" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n", port(run, "wr_addr"),
                   port(run, "wr_z"), port(run, "wr_r"), port(run, "wr_g"), port(run, "wr_b"));
    }
    printf("%" PRIu64 " clocks\n", edgewalk_run_clocks(run));
    edgewalk_run_free(run);
    edgewalk_frame_free(frame);
    edgewalk_machine_free(machine);
    return 0;
}
