// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 6db543e8dccb
edgewalk_setup_lane0.v
edgewalk_setup.v
edgewalk_edge.v
edgewalk_span_fifo.v
edgewalk_span.v
edgewalk_pixel.v
edgewalk_depth.v
edgewalk.v
