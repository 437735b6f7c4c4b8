/* Calls that must fail: prints code and message of each. */
#include "edgewalk.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static int failed;

static void fails(EdgewalkCode code) {
    printf("%d %s\n", (int)code, edgewalk_message());
    failed += code != EDGEWALK_CODE_OK;
}

static int must(EdgewalkCode code) {
    if (code != EDGEWALK_CODE_OK) printf("not expected: %s\n", edgewalk_message());
    return code == EDGEWALK_CODE_OK;
}

int main(void) {
    EdgewalkMachine *machine = NULL, *other = NULL;
    EdgewalkFrame *frame = NULL;
    EdgewalkRun *run = NULL;
    uint64_t value = 7;
    uint32_t z[1];
    double vertices[21] = {0};
    if (strlen(edgewalk_message()) != 0 || strcmp(edgewalk_version(), "0.1.0") != 0) return 1;

    fails(edgewalk_machine_preset(NULL, &machine));
    fails(edgewalk_machine_preset("small", NULL));
    fails(edgewalk_machine_preset("\xff", &machine));
    fails(edgewalk_machine_preset("smal", &machine));
    fails(edgewalk_machine_toml("[screen", &machine));
    fails(edgewalk_machine_toml("[screen]\nwidth = 0\n", &machine));
    if (machine != NULL || edgewalk_machine_width(NULL) != 0 || edgewalk_machine_height(NULL) != 0) return 1;
    if (!must(edgewalk_machine_preset("small", &machine))) return 1;
    if (edgewalk_machine_width(machine) != 240 || edgewalk_machine_height(machine) != 160) return 1;

    fails(edgewalk_frame_new(NULL, &frame));
    fails(edgewalk_frame_lines(NULL, "depth less"));
    if (!must(edgewalk_frame_new(machine, &frame))) return 1;
    fails(edgewalk_frame_lines(frame, NULL));
    fails(edgewalk_frame_triangle(frame, NULL));
    fails(edgewalk_draw(frame, z, NULL, NULL, 1, NULL));
    vertices[2] = NAN;
    if (!must(edgewalk_frame_triangle(frame, vertices))) return 1;
    fails(edgewalk_draw(frame, NULL, NULL, NULL, 240 * 160, NULL));
    fails(edgewalk_run_new(frame, &run));
    edgewalk_frame_free(frame);
    if (run != NULL || !must(edgewalk_frame_new(machine, &frame))) return 1;
    if (!must(edgewalk_frame_lines(frame, "depth les"))) return 1;
    fails(edgewalk_run_new(frame, &run));
    edgewalk_frame_free(frame);

    fails(edgewalk_run_tick(NULL));
    if (!edgewalk_run_is_done(NULL) || edgewalk_run_clocks(NULL) != 0) return 1;
    if (!must(edgewalk_frame_new(machine, &frame)) || !must(edgewalk_run_new(frame, &run))) return 1;
    edgewalk_frame_free(frame);
    edgewalk_machine_free(machine);
    if (!must(edgewalk_run_tick(run)) || !edgewalk_run_is_done(run) || edgewalk_run_clocks(run) != 1) return 1;
    fails(edgewalk_run_port(run, "wr_adr", 0, &value));
    fails(edgewalk_run_port(run, "wr_addr", 1, &value));
    fails(edgewalk_run_port(run, "wr_addr", 0, NULL));
    fails(edgewalk_run_port(NULL, "wr_addr", 0, &value));
    if (value != 7 || !must(edgewalk_run_port(run, "wr_addr", 0, &value))) return 1;
    edgewalk_run_free(run);
    edgewalk_machine_free(other);
    edgewalk_frame_free(NULL);
    edgewalk_run_free(NULL);
    printf("checked %d\n", failed);
    return 0;
}
