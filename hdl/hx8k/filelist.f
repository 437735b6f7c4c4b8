// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 7efc7d48fe81
edgewalk_setup_lane0.v
edgewalk_setup_lane1.v
edgewalk_setup.v
edgewalk_edge.v
edgewalk_span_fifo.v
edgewalk_span.v
edgewalk_pixel.v
edgewalk_depth.v
edgewalk.v
