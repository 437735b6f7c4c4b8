//! Where in the syntax the switch of a fault goes.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, UnOp};

use crate::fault::Fault;

/// What is written for the switch.
#[derive(Debug, PartialEq, Clone)]
pub enum Place {
    /// The expression of these bytes: a choice between it with the fault and it as it is.
    Expression(Range<usize>),
    /// A return at this byte, the start of a body.
    Body(usize),
    /// A guard at this byte, the end of an arm's pattern.
    Arm(usize),
}

/// All places of a file that a fault can be at.
#[derive(Default)]
pub struct Places {
    binaries: Vec<Binary>,
    unaries: Vec<(Range<usize>, Range<usize>)>,
    bodies: Vec<Range<usize>>,
    arms: Vec<(usize, usize)>,
    guards: Vec<(Range<usize>, bool)>,
    structures: Vec<Range<usize>>,
    parent: Option<usize>,
}

struct Binary {
    range: Range<usize>,
    operator: Range<usize>,
    binding: u8,
    /// The operation that it is an operand of, without parentheses between.
    parent: Option<usize>,
    /// Part of a condition with `let`, which is no expression.
    with_let: bool,
}

impl Places {
    /// Those of a source file.
    pub fn of(text: &str) -> syn::Result<Places> {
        let mut places = Places::default();
        places.visit_file(&syn::parse_file(text)?);
        Ok(places)
    }

    /// That of a fault, or why it has none.
    pub fn find(&self, fault: &Fault) -> Result<Place, &'static str> {
        let span = &fault.span;
        let holds = |range: &&Range<usize>| range.start <= span.start && span.end <= range.end;
        let smallest = |ranges: &mut dyn Iterator<Item = &Range<usize>>| {
            ranges.filter(holds).min_by_key(|range| range.len()).cloned()
        };
        match fault.genre.as_str() {
            "FnValue" => match smallest(&mut self.bodies.iter()) {
                Some(body) => Ok(Place::Body(body.start + 1)),
                None => Err("its function was not found"),
            },
            "BinaryOperator" => self.operation(fault),
            "UnaryOperator" => match self.unaries.iter().find(|(operator, _)| operator == span) {
                Some((_, range)) => Ok(Place::Expression(range.clone())),
                None => Err("its operator was not found"),
            },
            "MatchArmGuard" => match self.guards.iter().find(|(range, _)| range == span) {
                Some((_, true)) => Err("a guard with let"),
                Some((range, false)) => Ok(Place::Expression(range.clone())),
                None => Err("its guard was not found"),
            },
            "MatchArm" => match self.arms.iter().find(|(start, _)| *start == span.start) {
                Some((_, end)) => Ok(Place::Arm(*end)),
                None => Err("its arm was not found"),
            },
            "StructField" => match smallest(&mut self.structures.iter()) {
                Some(range) => Ok(Place::Expression(range)),
                None => Err("its value was not found"),
            },
            _ => Err("of an unknown kind"),
        }
    }

    /// That of a fault in an operator. The fault is one of the text: where the new operator binds less, operations around it
    /// that bind as much regroup, and belong to the place: `a - b * c` with `+` is `(a - b) + c`.
    fn operation(&self, fault: &Fault) -> Result<Place, &'static str> {
        let found = self.binaries.iter().position(|binary| binary.operator == fault.span);
        let mut at = found.ok_or("its operator was not found")?;
        let new = binding(fault.replacement.trim());
        while let Some(parent) = self.binaries[at].parent
            && self.binaries[parent].binding >= new
        {
            at = parent;
        }
        match &self.binaries[at] {
            Binary { with_let: true, .. } => Err("in a condition with let"),
            Binary { range, .. } => Ok(Place::Expression(range.clone())),
        }
    }
}

/// How much an operator binds its operands; those that assign least.
fn binding(operator: &str) -> u8 {
    match operator {
        "*" | "/" | "%" => 9,
        "+" | "-" => 8,
        "<<" | ">>" => 7,
        "&" => 6,
        "^" => 5,
        "|" => 4,
        "==" | "!=" | "<" | ">" | "<=" | ">=" => 3,
        "&&" => 2,
        "||" => 1,
        _ => 0,
    }
}

fn spelled(operator: &BinOp) -> &'static str {
    match operator {
        BinOp::Mul(_) | BinOp::Div(_) | BinOp::Rem(_) => "*",
        BinOp::Add(_) | BinOp::Sub(_) => "+",
        BinOp::Shl(_) | BinOp::Shr(_) => "<<",
        BinOp::BitAnd(_) => "&",
        BinOp::BitXor(_) => "^",
        BinOp::BitOr(_) => "|",
        BinOp::Eq(_) | BinOp::Ne(_) | BinOp::Lt(_) | BinOp::Gt(_) | BinOp::Le(_) | BinOp::Ge(_) => "==",
        BinOp::And(_) => "&&",
        BinOp::Or(_) => "||",
        _ => "=",
    }
}

fn with_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => with_let(&binary.left) || with_let(&binary.right),
        _ => false,
    }
}

fn bytes(node: &impl Spanned) -> Range<usize> {
    node.span().byte_range()
}

impl<'ast> Visit<'ast> for Places {
    fn visit_expr_binary(&mut self, node: &'ast syn::ExprBinary) {
        let parent = self.parent.take();
        let place = self.binaries.len();
        self.binaries.push(Binary {
            range: bytes(node),
            operator: bytes(&node.op),
            binding: binding(spelled(&node.op)),
            parent,
            with_let: with_let(&node.left) || with_let(&node.right),
        });
        for operand in [&node.left, &node.right] {
            self.parent = matches!(**operand, Expr::Binary(_)).then_some(place);
            self.visit_expr(operand);
        }
    }

    fn visit_expr_unary(&mut self, node: &'ast syn::ExprUnary) {
        if matches!(node.op, UnOp::Not(_) | UnOp::Neg(_)) {
            self.unaries.push((bytes(&node.op), bytes(node)));
        }
        visit::visit_expr_unary(self, node);
    }

    fn visit_item_fn(&mut self, node: &'ast syn::ItemFn) {
        self.bodies.push(bytes(&node.block));
        visit::visit_item_fn(self, node);
    }

    fn visit_impl_item_fn(&mut self, node: &'ast syn::ImplItemFn) {
        self.bodies.push(bytes(&node.block));
        visit::visit_impl_item_fn(self, node);
    }

    fn visit_trait_item_fn(&mut self, node: &'ast syn::TraitItemFn) {
        self.bodies.extend(node.default.as_ref().map(bytes));
        visit::visit_trait_item_fn(self, node);
    }

    fn visit_arm(&mut self, node: &'ast syn::Arm) {
        self.arms.push((bytes(node).start, bytes(&node.pat).end));
        if let Some((_, guard)) = &node.guard {
            self.guards.push((bytes(guard), with_let(guard)));
        }
        visit::visit_arm(self, node);
    }

    fn visit_expr_struct(&mut self, node: &'ast syn::ExprStruct) {
        self.structures.push(bytes(node));
        visit::visit_expr_struct(self, node);
    }
}
