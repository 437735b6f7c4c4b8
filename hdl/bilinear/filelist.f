// SPDX-License-Identifier: MIT OR Apache-2.0
// edgewalk 0.1.0, machine 332c0ada4a3a
edgewalk_setup_lane0.v
edgewalk_setup_lane1.v
edgewalk_setup.v
edgewalk_poly.v
edgewalk_span_fifo.v
edgewalk_span.v
edgewalk_pixel.v
edgewalk_depth.v
edgewalk.v
