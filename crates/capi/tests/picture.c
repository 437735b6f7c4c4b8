/* Two triangles under a rule of their own: the picture drawn at once beside that of the writes. */
#include "edgewalk.h"
#include <stdio.h>
#include <string.h>

enum { WIDTH = 240, HEIGHT = 160, PIXELS = WIDTH * HEIGHT };

static uint32_t z[PIXELS], rgb[PIXELS][3], own_z[PIXELS], own_rgb[PIXELS][3];
static int32_t id[PIXELS];

static uint64_t port(const EdgewalkRun *run, const char *name) {
    uint64_t value = 0;
    if (edgewalk_run_port(run, name, 0, &value) != EDGEWALK_CODE_OK) printf("%s\n", edgewalk_message());
    return value;
}

int main(void) {
    const double triangle[21] = {20, 10, 0.5, 1, 0, 0, 0, 90, 30, 0.4, 0, 1, 0, 0, 40, 75, 0.3, 0, 0, 1, 0};
    EdgewalkMachine *machine;
    EdgewalkFrame *frame;
    EdgewalkRun *run;
    uint64_t cycles;
    if (edgewalk_machine_preset("small", &machine) || edgewalk_frame_new(machine, &frame)) return 1;
    if (edgewalk_frame_lines(frame, "depth_write 0\nclear 0 0 0\nT 10 12 .9 1 1 1 0  80 14 .9 1 1 0 0  30 60 .9 1 1 1 0"))
        return 1;
    if (edgewalk_frame_triangle(frame, triangle)) return 1;
    if (edgewalk_draw(frame, z, rgb[0], id, PIXELS, &cycles) || edgewalk_run_new(frame, &run)) return 1;
    memset(own_z, 0, sizeof own_z);
    for (int i = 0; i < PIXELS; i++) own_z[i] = 65535;
    while (!edgewalk_run_is_done(run)) {
        if (edgewalk_run_tick(run)) return 1;
        if (!port(run, "wr_valid") || !port(run, "wr_ready")) continue;
        const uint64_t address = port(run, "wr_addr"), at = (address >> 8) * WIDTH + (address & 255);
        if (port(run, "wr_z_en")) own_z[at] = (uint32_t)port(run, "wr_z");
        own_rgb[at][0] = (uint32_t)port(run, "wr_r");
        own_rgb[at][1] = (uint32_t)port(run, "wr_g");
        own_rgb[at][2] = (uint32_t)port(run, "wr_b");
    }
    int differ = cycles != edgewalk_run_clocks(run), second = 0;
    for (int i = 0; i < PIXELS; i++) {
        differ += z[i] != own_z[i] || memcmp(rgb[i], own_rgb[i], sizeof rgb[i]) != 0;
        second += id[i] == 1;
    }
    printf("checked %d pixels, %d differ; %d written by triangle 1\n", PIXELS, differ, second);
    edgewalk_run_free(run);
    edgewalk_frame_free(frame);
    edgewalk_machine_free(machine);
    return differ != 0;
}
