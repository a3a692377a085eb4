//! The classical quadtree: a node is a rectangle and a list.
//!
//! A disc goes down into the one child that contains it wholly; one that straddles a split stays in the list of the
//! node it has reached; one that sticks out of the root stays in the root's list. Leaves stop at a smallest size.
//! Discs that moved into another node are removed and inserted; the rest of the tree stays.

use super::rectangle::Rectangle;
use super::{Broadphase, Discs, Pair, Part, Settings, slack};
use crate::{Team, Vec2};

const NONE: u32 = u32::MAX;
const MAX_DEPTH: u32 = 24;

struct Node {
    rectangle: Rectangle,
    depth: u32,
    parent: u32,
    children: [u32; 4],
    list: Vec<u32>,
    /// Discs in this node and below it: a query passes over what is empty.
    population: u32,
}

struct Place {
    node: u32,
    bounds: Rectangle,
}

pub(super) struct Quadtree {
    root: [f64; 4],
    smallest: Option<f64>,
    depth: u32,
    nodes: Vec<Node>,
    places: Vec<Place>,
}

impl Quadtree {
    pub(super) fn new(settings: &Settings) -> Quadtree {
        Quadtree {
            root: settings.root,
            smallest: settings.smallest_node,
            depth: 0,
            nodes: Vec::new(),
            places: Vec::new(),
        }
    }

    fn depth_for(&self, discs: &Discs<'_>) -> u32 {
        let widest = (0..discs.len()).fold(0.0, |most: f64, i| most.max(discs.reach.of(i)));
        let smallest = self.smallest.unwrap_or(4.0 * widest);
        let [left, bottom, right, top] = self.root;
        let mut side = (right - left).min(top - bottom);
        let mut depth = 0;
        while depth < MAX_DEPTH && 0.5 * side >= smallest {
            side *= 0.5;
            depth += 1;
        }
        depth
    }

    fn clear(&mut self) {
        let [left, bottom, right, top] = self.root;
        let rectangle = Rectangle {
            left,
            bottom,
            right,
            top,
        };
        self.nodes.clear();
        self.nodes.push(Node {
            rectangle,
            depth: 0,
            parent: NONE,
            children: [NONE; 4],
            list: Vec::new(),
            population: 0,
        });
        self.places.clear();
    }

    /// The node whose list a disc with these bounds belongs to.
    fn descend(&mut self, bounds: &Rectangle) -> u32 {
        let mut at = 0u32;
        if !self.nodes[0].rectangle.contains(bounds) {
            return at;
        }
        loop {
            let node = &self.nodes[at as usize];
            if node.depth >= self.depth {
                return at;
            }
            let quarters = node.rectangle.quarters();
            let Some(quarter) = quarters.iter().position(|quarter| quarter.contains(bounds)) else {
                return at;
            };
            let (depth, child) = (node.depth + 1, node.children[quarter]);
            at = if child == NONE {
                self.grow(at, quarter, quarters[quarter], depth)
            } else {
                child
            };
        }
    }

    fn grow(&mut self, parent: u32, quarter: usize, rectangle: Rectangle, depth: u32) -> u32 {
        let child = self.nodes.len() as u32;
        self.nodes[parent as usize].children[quarter] = child;
        self.nodes.push(Node {
            rectangle,
            depth,
            parent,
            children: [NONE; 4],
            list: Vec::new(),
            population: 0,
        });
        child
    }

    fn insert(&mut self, index: u32, bounds: &Rectangle) -> u32 {
        let node = self.descend(bounds);
        self.nodes[node as usize].list.push(index);
        self.count(node, 1);
        node
    }

    fn remove(&mut self, index: u32, node: u32) {
        let list = &mut self.nodes[node as usize].list;
        if let Some(at) = list.iter().position(|&other| other == index) {
            list.swap_remove(at);
            self.count(node, -1);
        }
    }

    fn count(&mut self, node: u32, change: i32) {
        let mut at = node;
        while at != NONE {
            let node = &mut self.nodes[at as usize];
            node.population = node.population.wrapping_add_signed(change);
            at = node.parent;
        }
    }

    fn place(&mut self, index: usize, bounds: Rectangle) {
        let old = self.places[index].node;
        let new = self.descend(&bounds);
        if new != old {
            self.remove(index as u32, old);
            self.nodes[new as usize].list.push(index as u32);
            self.count(new, 1);
        }
        self.places[index] = Place { node: new, bounds };
    }

    fn visit(&self, at: u32, bounds: &Rectangle, show: &mut impl FnMut(u32)) {
        let node = &self.nodes[at as usize];
        for &index in &node.list {
            if self.places[index as usize].bounds.touches(bounds) {
                show(index);
            }
        }
        for child in node.children {
            if child == NONE {
                continue;
            }
            let below = &self.nodes[child as usize];
            if below.population > 0 && below.rectangle.touches(bounds) {
                self.visit(child, bounds, show);
            }
        }
    }
}

/// Where a disc looks for others.
fn looking_from(center: Vec2, reach: f64) -> Rectangle {
    Rectangle::around(center, reach + slack(center, reach))
}

impl Broadphase for Quadtree {
    fn build(&mut self, discs: &Discs<'_>, _team: &Team) {
        let depth = self.depth_for(discs);
        if depth != self.depth || discs.len() != self.places.len() || self.nodes.is_empty() {
            self.depth = depth;
            self.clear();
            for index in 0..discs.len() {
                let bounds = Rectangle::around(discs.center[index], discs.reach.of(index));
                let node = self.insert(index as u32, &bounds);
                self.places.push(Place { node, bounds });
            }
            return;
        }
        for index in 0..discs.len() {
            self.place(
                index,
                Rectangle::around(discs.center[index], discs.reach.of(index)),
            );
        }
    }

    fn pairs_of(&self, discs: &Discs<'_>, part: Part, found: &mut Vec<Pair>) {
        if part.number > 0 || self.nodes.is_empty() {
            return;
        }
        for index in 0..discs.len() {
            let around = looking_from(discs.center[index], discs.reach.of(index));
            self.visit(0, &around, &mut |other| {
                if (other as usize) > index && discs.overlap(index, other as usize) {
                    found.push((index as u32, other));
                }
            });
        }
    }

    fn relocate(&mut self, index: usize, center: Vec2, reach: f64) {
        self.place(index, Rectangle::around(center, reach));
    }

    fn query(&self, center: Vec2, reach: f64, found: &mut Vec<u32>) {
        if !self.nodes.is_empty() {
            self.visit(0, &looking_from(center, reach), &mut |index| found.push(index));
        }
    }

    fn nodes(&self) -> Vec<[f64; 4]> {
        let occupied = self.nodes.iter().filter(|node| node.population > 0);
        occupied
            .map(|node| {
                let Rectangle {
                    left,
                    bottom,
                    right,
                    top,
                } = node.rectangle;
                [left, bottom, right, top]
            })
            .collect()
    }
}
