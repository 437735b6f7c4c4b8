//! The values of all ports in one cycle, by the id that the interface gave to each.

use std::ops::{Index, IndexMut, Range};

/// A port of an [`crate::Interface`], found once by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PortId(pub(crate) usize);

/// The values of all ports of a device in a cycle, each below 2^width.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PortValues {
    /// The reset.
    pub rst: bool,
    values: Vec<u128>,
    inputs: usize,
    /// Not hardware: for each link, the number of the triangle whose token stands there, where the device knows it.
    triangles: Vec<Option<u32>>,
}

impl PortValues {
    pub(crate) fn new(inputs: usize, ports: usize, links: usize) -> PortValues {
        PortValues { rst: false, values: vec![0; ports], inputs, triangles: vec![None; links] }
    }

    /// The same inputs.
    pub fn copy_inputs(&mut self, from: &PortValues) {
        self.rst = from.rst;
        self.values[..self.inputs].copy_from_slice(&from.values[..self.inputs]);
        self.triangles.copy_from_slice(&from.triangles);
    }

    /// A port of one bit.
    #[must_use]
    pub fn is_high(&self, port: PortId) -> bool {
        self[port] == 1
    }

    /// Sets a port to a flag.
    pub fn set(&mut self, port: PortId, value: bool) {
        self[port] = u128::from(value);
    }

    /// Of every port, by its number.
    pub(crate) fn all_mut(&mut self) -> &mut [u128] {
        &mut self.values
    }

    pub(crate) fn range(&self, ports: &Range<usize>) -> &[u128] {
        &self.values[ports.clone()]
    }

    pub(crate) fn range_mut(&mut self, ports: &Range<usize>) -> &mut [u128] {
        &mut self.values[ports.clone()]
    }

    /// The triangle whose token stands at the link with this number.
    #[must_use]
    pub fn triangle(&self, link: usize) -> Option<u32> {
        self.triangles[link]
    }

    pub(crate) fn set_triangle(&mut self, link: usize, triangle: Option<u32>) {
        self.triangles[link] = triangle;
    }
}

impl Index<PortId> for PortValues {
    type Output = u128;

    fn index(&self, port: PortId) -> &u128 {
        &self.values[port.0]
    }
}

impl IndexMut<PortId> for PortValues {
    fn index_mut(&mut self, port: PortId) -> &mut u128 {
        &mut self.values[port.0]
    }
}
