//! Peaks, found inside every accepted step.

use pounding_hysteresis::{MAXIMUM_INTERNAL_VARIABLES, Motion};
use pounding_shear_building::ShearBuilding;

use crate::dynamics::{Context, Instant};
use crate::events::{Finder, penetration, velocity};
use crate::layout::Layout;
use crate::methods::{LARGE, Method};
use crate::outcome::StoreyPeaks;
use crate::peak::Peak;
use crate::polynomial::{
    Polynomial, absolute_maximum, bound, derivative, difference, fit, fit_nodes, maximum_above,
    value,
};
use crate::system::{Element, ElementPlace, SectionForce, SectionPlace, System};

mod accelerations;
mod branches;
mod low_order;

/// Peaks of all storeys, and of the levels in contact.
#[derive(Debug)]
pub(crate) struct Peaks {
    pub storeys: Vec<StoreyPeaks>,
    /// Overturning moment at the base of every building (N m), where it is followed.
    pub base_moment: Vec<Peak>,
    /// Responses with names, of all buildings.
    pub named: Vec<Peak>,
    /// Responses of contact levels.
    pub of_levels: Vec<Peak>,
    /// Maximum force of each level during its present impact (N).
    pub force: Vec<Peak>,
    /// Maximum penetration of each level during its present impact (m).
    pub penetration: Vec<Peak>,
    /// Peaks of every element: deformation (m) and force (N).
    pub elements: Vec<ElementPeaks>,
    state: Vec<f64>,
    /// Accelerations at the start and at the end of the present step, where many floors
    /// have their maximum ones, and at the last place inside it, with these places; NaN
    /// before they are known.
    acceleration: [Vec<f64>; 3],
    at: [f64; 3],
    /// Storey heights of all buildings (m).
    height: Vec<f64>,
    /// Elements of a section within a step.
    parts: Vec<SectionPart>,
    /// What accelerations reach in a step, of floors and then of sums of them.
    reached: Vec<branches::Reached>,
    /// Accelerations at the nodes of a fit, of the same.
    samples: Vec<Polynomial>,
}

/// Peaks of a storey with a law, or of a level of a link.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ElementPeaks {
    pub deformation: Peak,
    pub force: Peak,
}

/// An element of a section: its number, its weight, and the interpolants of its deformation and of the rate of it.
type SectionPart = (usize, f64, [Polynomial; 2]);

/// Part of the present peak below which a fitted maximum is not looked at
/// closer: fits err by less.
const NEAR: f64 = 1.0 - 1.0e-6;

impl Peaks {
    pub(crate) fn new(layout: Layout, system: &System) -> Self {
        let buildings = system.buildings();
        Self {
            storeys: vec![StoreyPeaks::default(); system.floors()],
            base_moment: vec![Peak::default(); buildings.len()],
            named: vec![Peak::default(); system.named_responses()],
            of_levels: vec![Peak::default(); system.level_rows().len()],
            force: vec![Peak::default(); layout.levels],
            penetration: vec![Peak::default(); layout.levels],
            elements: vec![ElementPeaks::default(); system.elements().len()],
            state: vec![0.0; layout.motion()],
            acceleration: std::array::from_fn(|_| vec![0.0; layout.dofs]),
            at: [f64::NAN; 3],
            height: buildings.iter().flat_map(|b| b.height()).copied().collect(),
            parts: Vec::new(),
            reached: Vec::new(),
            samples: Vec::new(),
        }
    }

    /// Takes the state at time zero in, with all gaps open.
    pub(crate) fn begin(&mut self, context: &mut Context<'_, '_>, state: &[f64]) {
        let (u, ground) = (state, context.segment.ground(0.0));
        let now = Instant::committed(ground);
        let out = &mut self.acceleration[0];
        context
            .dynamics
            .accelerations(context.contacts, now, state, out);
        let system = context.dynamics.system;
        for (building, range) in system.buildings().iter().zip(system.offsets().windows(2)) {
            let mut below = 0.0;
            for (storey, i) in (range[0]..range[1]).enumerate() {
                let (drift, peaks) = ((u[i] - below).abs(), &mut self.storeys[i]);
                let acceleration = (self.acceleration[0][i] + system.ground_on(i, ground)).abs();
                peaks.displacement.raise(u[i].abs(), 0.0);
                if building.drifts().is_none() {
                    peaks
                        .drift_ratio
                        .raise(drift / building.height()[storey], 0.0);
                }
                if let (None, Some(stiffness)) =
                    (&building.laws()[storey], building.stiffness().get(storey))
                {
                    peaks.storey_shear.raise(stiffness * drift, 0.0);
                }
                peaks.acceleration_absolute.raise(acceleration, 0.0);
                below = u[i];
            }
        }
        for section in system.sections() {
            let mut sum = section.at(u);
            for (index, weight) in &section.elements {
                let dynamics = &mut *context.dynamics;
                sum += weight * dynamics.element_force(context.contacts, *index, state, None);
            }
            self.raise_section(section.place, sum.abs(), 0.0);
        }
        for row in system.acceleration_rows() {
            let own = |i: usize| self.acceleration[0][i] + system.ground_on(i, ground);
            let sum: f64 = row.terms().map(|(i, w)| w * own(i)).sum();
            self.raise_section(row.place, sum.abs(), 0.0);
        }
        for (row, peak) in system.level_rows().iter().zip(&mut self.of_levels) {
            let sum: f64 = row.terms.iter().map(|(i, w)| w * u[*i]).sum();
            peak.raise(if row.one_sided { sum } else { sum.abs() }, 0.0);
        }
        for (index, element) in system.elements().iter().enumerate() {
            let force = context
                .dynamics
                .element_force(context.contacts, index, state, None);
            self.elements[index]
                .deformation
                .raise(element.relative(u).abs(), 0.0);
            self.raise_force(element, index, force.abs(), 0.0);
        }
    }

    /// Raises the peak of a response that is a sum over coordinates.
    pub(crate) fn raise_section(&mut self, place: SectionPlace, value: f64, time: f64) {
        match place {
            SectionPlace::StoreyShear(floor) => {
                self.storeys[floor].storey_shear.raise(value, time);
            }
            SectionPlace::BaseMoment(building) => self.base_moment[building].raise(value, time),
            SectionPlace::Drift(floor) => {
                let ratio = value / self.height[floor];
                self.storeys[floor].drift_ratio.raise(ratio, time);
            }
            SectionPlace::Named(response) => self.named[response].raise(value, time),
        }
    }

    /// The same, to be read.
    pub(crate) fn of_section(&self, place: SectionPlace) -> Peak {
        match place {
            SectionPlace::StoreyShear(floor) => self.storeys[floor].storey_shear,
            SectionPlace::BaseMoment(building) => self.base_moment[building],
            SectionPlace::Drift(floor) => Peak {
                value: self.storeys[floor].drift_ratio.value * self.height[floor],
                ..self.storeys[floor].drift_ratio
            },
            SectionPlace::Named(response) => self.named[response],
        }
    }

    fn raise_force(&mut self, element: &Element, index: usize, force: f64, time: f64) {
        self.elements[index].force.raise(force, time);
        if let (ElementPlace::Storey { .. }, Some(dof)) = (element.place, element.far) {
            self.storeys[dof].storey_shear.raise(force, time);
        }
    }

    /// Takes an accepted step in: `place` is tau and step length (s).
    pub(crate) fn step(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        finder: &mut Finder,
        place: (f64, f64),
    ) {
        let system = context.dynamics.system;
        finder.forget();
        self.at = [f64::NAN; 3];
        for (building, range) in system.buildings().iter().zip(system.offsets().windows(2)) {
            self.building(context, method, building, range[0], place);
        }
        for section in system.sections() {
            let mut force = Polynomial::default();
            for (i, weight) in section.terms() {
                for (sum, c) in force.iter_mut().zip(method.polynomial(i)) {
                    *sum += weight * c;
                }
            }
            if !section.elements.is_empty() {
                self.section_with_elements(context, method, (section, &force), place);
                continue;
            }
            let peak = self.of_section(section.place).value;
            if let Some((theta, top)) = absolute_maximum(&force, peak) {
                let time = context.segment.start + place.0 + theta * place.1;
                self.raise_section(section.place, top, time);
            }
        }
        for index in 0..system.level_rows().len() {
            self.level_row(context, method, finder, index, place);
        }
        for k in 0..context.contacts.closed().len() {
            let level = context.contacts.closed()[k];
            self.contact(context, method, finder, level, place);
        }
        for index in 0..self.elements.len() {
            self.element(context, method, index, place);
        }
        self.accelerations_in(context, method, place);
    }

    /// Absolute accelerations of floors, and sums of them. Interpolants of adaptive methods tell where they peak;
    /// those of fixed steps are of low order, and laws that an implicit step holds have kinks in it.
    fn accelerations_in(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
    ) {
        let information = method.information();
        let has_kinks = information.implicit && !self.elements.is_empty();
        if !information.adaptive && !has_kinks {
            self.accelerations_within(context, method, place);
            return;
        }
        let (dofs, system) = (context.dynamics.layout.dofs, context.dynamics.system);
        for i in 0..self.storeys.len() {
            self.absolute_acceleration(context, method, (i, dofs + i), place);
        }
        for row in system.acceleration_rows() {
            self.acceleration_row(context, method, row, place);
        }
        if has_kinks {
            self.accelerations_between_branches(context, method, place);
        }
    }

    /// A response of a contact level, with the contact force at the nodes of a fit.
    fn level_row(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        finder: &mut Finder,
        index: usize,
        (tau, step): (f64, f64),
    ) {
        let row = &context.dynamics.system.level_rows()[index];
        let mut sum = Polynomial::default();
        for (i, weight) in &row.terms {
            for (sum, c) in sum.iter_mut().zip(method.polynomial(*i)) {
                *sum += weight * c;
            }
        }
        if row.by_force != 0.0 && context.contacts.contact(row.level).is_some() {
            let (delta, rate) = (
                penetration(context, method, row.level),
                velocity(context, method, row.level),
            );
            let forces = fit_nodes().map(|theta| {
                let at = (value(&delta, theta), value(&rate, theta));
                force_of(context, method, finder, row.level, (tau, step, theta), at)
            });
            for (sum, c) in sum.iter_mut().zip(fit(&forces)) {
                *sum += row.by_force * c;
            }
        }
        let peak = &mut self.of_levels[index];
        let found = match row.one_sided {
            true => maximum_above(&sum, peak.value),
            false => absolute_maximum(&sum, peak.value),
        };
        if let Some((theta, top)) = found {
            peak.raise(top, context.segment.start + tau + theta * step);
        }
    }

    /// Deformation from the interpolant; force of the law along it.
    fn element(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        index: usize,
        (tau, step): (f64, f64),
    ) {
        let system = context.dynamics.system;
        let start = context.segment.start + tau;
        let element = &system.elements()[index];
        let deformation = element.polynomial(|i| *method.polynomial(i), 0);
        let peak = &mut self.elements[index].deformation;
        if let Some((theta, top)) = absolute_maximum(&deformation, peak.value) {
            peak.raise(top, start + theta * step);
        }
        let implicit = method.information().implicit;
        let velocity = element.polynomial(|i| *method.polynomial(i), context.dynamics.layout.dofs);
        let motion = [deformation, velocity];
        let slope = match implicit {
            true => (element.law).slope_bound(&context.contacts.elements.histories[index]),
            false => None,
        };
        let mut force =
            |theta: f64| force_of_element(context, method, (index, &motion), (theta, step));
        if let Some(slope) = slope {
            let ends = [force(0.0), force(1.0)];
            if branches::most_on_path(&motion[0], ends, slope) <= self.elements[index].force.value {
                return;
            }
        }
        let samples = fit_nodes().map(&mut force);
        let fitted = fit(&samples);
        let maximum = self.elements[index].force.value;
        let most = bound(&fitted).max(bound(&fitted.map(|c| -c)));
        if most <= maximum * if implicit { branches::FAR } else { NEAR } {
            return;
        }
        for (theta, sample) in fit_nodes().iter().zip(samples) {
            self.raise_force(element, index, sample.abs(), start + theta * step);
        }
        // What the law of a step holds is smooth only where its branches are located.
        if implicit {
            let peak = self.elements[index].force.value;
            let (theta, top) = branches::largest(peak, |theta| force(theta).abs());
            self.raise_force(element, index, top, start + theta * step);
            return;
        }
        let near = self.elements[index].force.value * NEAR;
        if let Some((theta, _)) = absolute_maximum(&fitted, near) {
            let exact = force(theta).abs();
            self.raise_force(element, index, exact, start + theta * step);
        }
    }

    /// A sum over coordinates, by its interpolant, and over forces of elements along theirs.
    fn section_with_elements(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (section, row): (&SectionForce, &Polynomial),
        (tau, step): (f64, f64),
    ) {
        let (system, dofs) = (context.dynamics.system, context.dynamics.layout.dofs);
        let start = context.segment.start + tau;
        let of = |(index, weight): &(usize, f64)| {
            let element = &system.elements()[*index];
            let motion = [0, dofs].map(|at| element.polynomial(|i| *method.polynomial(i), at));
            (*index, *weight, motion)
        };
        let mut parts = std::mem::take(&mut self.parts);
        parts.clear();
        parts.extend(section.elements.iter().map(of));
        self.sum_of_parts(context, method, (section, row, &parts), (start, step));
        self.parts = parts;
    }

    /// The same with the elements along the step.
    fn sum_of_parts(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (section, row, parts): (&SectionForce, &Polynomial, &[SectionPart]),
        (start, step): (f64, f64),
    ) {
        let implicit = method.information().implicit;
        let mut sum = |theta: f64| {
            let of = |(index, weight, motion): &SectionPart| {
                let element = (*index, motion);
                weight * force_of_element(context, method, element, (theta, step))
            };
            value(row, theta) + parts.iter().map(of).sum::<f64>()
        };
        let samples = fit_nodes().map(&mut sum);
        let fitted = fit(&samples);
        let present = self.of_section(section.place).value;
        let most = bound(&fitted).max(bound(&fitted.map(|c| -c)));
        if most <= present * if implicit { branches::FAR } else { NEAR } {
            return;
        }
        for (theta, sample) in fit_nodes().iter().zip(samples) {
            self.raise_section(section.place, sample.abs(), start + theta * step);
        }
        if implicit {
            let peak = self.of_section(section.place).value;
            let (theta, top) = branches::largest(peak, |theta| sum(theta).abs());
            self.raise_section(section.place, top, start + theta * step);
            return;
        }
        let near = self.of_section(section.place).value * NEAR;
        if let Some((theta, _)) = absolute_maximum(&fitted, near) {
            let exact = sum(theta).abs();
            self.raise_section(section.place, exact, start + theta * step);
        }
    }

    fn building(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        building: &ShearBuilding,
        offset: usize,
        (tau, step): (f64, f64),
    ) {
        let start = context.segment.start + tau;
        let mut below: Option<&Polynomial> = None;
        for storey in 0..building.storeys() {
            let i = offset + storey;
            let u = method.polynomial(i);
            let peaks = &mut self.storeys[i];
            if let Some((theta, top)) = absolute_maximum(u, peaks.displacement.value) {
                peaks.displacement.raise(top, start + theta * step);
            }
            let drift = below.map_or(*u, |b| difference(u, b));
            let height = building.height()[storey];
            let present = peaks.drift_ratio.value * height * NEAR;
            if building.drifts().is_none()
                && let Some((theta, top)) = absolute_maximum(&drift, present)
            {
                let time = start + theta * step;
                peaks.drift_ratio.raise(top / height, time);
                if let (None, Some(stiffness)) =
                    (&building.laws()[storey], building.stiffness().get(storey))
                {
                    peaks.storey_shear.raise(stiffness * top, time);
                }
            }
            below = Some(u);
        }
    }

    /// The interpolant's second derivative tells where to look; the equations of
    /// motion give the value there.
    fn absolute_acceleration(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (i, velocity): (usize, usize),
        (tau, step): (f64, f64),
    ) {
        let system = context.dynamics.system;
        let a = self.acceleration_polynomial(context, method, (i, velocity), (tau, step));
        let floor = self.storeys[i].acceleration_absolute.value * NEAR;
        let Some((theta, _)) = absolute_maximum(&a, floor) else {
            return;
        };
        let ground = context.segment.ground(tau + theta * step);
        let own_ground = system.ground_on(i, ground);
        let time = context.segment.start + tau + theta * step;
        let place = match theta {
            0.0 => 0,
            1.0 => 1,
            _ => 2,
        };
        if place == 2 && context.dynamics.layout.dofs > LARGE {
            let at = |k: usize| value(method.polynomial(k), theta);
            let contacts = context.contacts;
            if let Some(own) = context.dynamics.acceleration_of(contacts, (i, ground), at) {
                let peak = &mut self.storeys[i].acceleration_absolute;
                peak.raise((own + own_ground).abs(), time);
                return;
            }
            if context.dynamics.held_by_itself(contacts, ground, &at) {
                let floor = (i, ground);
                let own = (context.dynamics).held_acceleration_of(contacts, floor, &at);
                let peak = &mut self.storeys[i].acceleration_absolute;
                peak.raise((own + own_ground).abs(), time);
                return;
            }
        }
        self.evaluate_at(context, method, (tau, step), (place, theta));
        let exact = (self.acceleration[place][i] + own_ground).abs();
        self.storeys[i].acceleration_absolute.raise(exact, time);
    }

    /// Absolute acceleration of a degree of freedom by the interpolant of its velocity.
    fn acceleration_polynomial(
        &self,
        context: &Context<'_, '_>,
        method: &dyn Method,
        (i, velocity): (usize, usize),
        (tau, step): (f64, f64),
    ) -> Polynomial {
        let system = context.dynamics.system;
        let mut a = derivative(method.polynomial(velocity)).map(|c| c / step);
        a[0] += system.ground_on(i, context.segment.ground(tau));
        a[1] += system.ground_slope_on(i, context.segment) * step;
        a
    }

    /// The same of a sum over degrees of freedom.
    fn sum_of_accelerations(
        &self,
        context: &Context<'_, '_>,
        method: &dyn Method,
        row: &SectionForce,
        place: (f64, f64),
    ) -> Polynomial {
        let dofs = context.dynamics.layout.dofs;
        let mut sum = Polynomial::default();
        for (i, weight) in row.terms() {
            let a = self.acceleration_polynomial(context, method, (i, dofs + i), place);
            for (sum, c) in sum.iter_mut().zip(a) {
                *sum += weight * c;
            }
        }
        sum
    }

    /// A response that is a sum of absolute accelerations: where it may be at its maximum by the
    /// interpolant, the equations of motion give the value.
    fn acceleration_row(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        row: &SectionForce,
        (tau, step): (f64, f64),
    ) {
        let system = context.dynamics.system;
        let sum = self.sum_of_accelerations(context, method, row, (tau, step));
        let floor = self.of_section(row.place).value * NEAR;
        let Some((theta, _)) = absolute_maximum(&sum, floor) else {
            return;
        };
        let place = match theta {
            0.0 => 0,
            1.0 => 1,
            _ => 2,
        };
        self.evaluate_at(context, method, (tau, step), (place, theta));
        let ground = context.segment.ground(tau + theta * step);
        let own = |i: usize| self.acceleration[place][i] + system.ground_on(i, ground);
        let exact: f64 = row.terms().map(|(i, w)| w * own(i)).sum();
        let time = context.segment.start + tau + theta * step;
        self.raise_section(row.place, exact.abs(), time);
    }

    /// Accelerations at a place in the step, unless they are known.
    fn evaluate_at(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (tau, step): (f64, f64),
        (place, theta): (usize, f64),
    ) {
        if theta != self.at[place] {
            self.at[place] = theta;
            for (k, y) in self.state.iter_mut().enumerate() {
                *y = value(method.polynomial(k), theta);
            }
            let ground = context.segment.ground(tau + theta * step);
            let now = Instant::within(ground, method.information().implicit, theta * step);
            let out = &mut self.acceleration[place];
            context
                .dynamics
                .accelerations(context.contacts, now, &self.state, out);
        }
    }

    fn contact(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        finder: &mut Finder,
        l: usize,
        (tau, step): (f64, f64),
    ) {
        let start = context.segment.start + tau;
        let delta = penetration(context, method, l);
        if let Some((theta, top)) = maximum_above(&delta, self.penetration[l].value) {
            self.penetration[l].raise(top, start + theta * step);
        }
        let rate = velocity(context, method, l);
        let mut force = |theta: f64| -> f64 {
            let at = (value(&delta, theta), value(&rate, theta));
            force_of(context, method, finder, l, (tau, step, theta), at)
        };
        let samples = fit_nodes().map(&mut force);
        let fitted = fit(&samples);
        if bound(&fitted) <= self.force[l].value * NEAR {
            return;
        }
        let peak = &mut self.force[l];
        for (theta, sample) in fit_nodes().iter().zip(samples) {
            peak.raise(sample, start + theta * step);
        }
        if let Some((theta, _)) = maximum_above(&fitted, peak.value * NEAR) {
            peak.raise(force(theta), start + theta * step);
        }
    }
}

/// Force of an element at a place in the step, from the interpolants of its deformation and of the
/// rate of it.
fn force_of_element(
    context: &mut Context<'_, '_>,
    method: &dyn Method,
    (index, [deformation, velocity]): (usize, &[Polynomial; 2]),
    (theta, step): (f64, f64),
) -> f64 {
    let own = context.dynamics.system.elements()[index].range(context.dynamics.layout);
    let motion = Motion {
        deformation: value(deformation, theta),
        velocity: value(velocity, theta),
    };
    let mut variables = [0.0; MAXIMUM_INTERNAL_VARIABLES];
    for (variable, i) in variables.iter_mut().zip(own.clone()) {
        *variable = value(method.polynomial(i), theta);
    }
    let implicit = method.information().implicit;
    let elapsed = (implicit && theta > 0.0).then_some(theta * step);
    let at = (motion, &variables[..own.len()]);
    let dynamics = &mut *context.dynamics;
    dynamics.element_force_at(context.contacts, index, at, elapsed)
}

/// Force of a closed level at a place in the step, with its penetration and their rate there.
fn force_of(
    context: &mut Context<'_, '_>,
    method: &dyn Method,
    finder: &mut Finder,
    level: usize,
    place: (f64, f64, f64),
    (delta, rate): (f64, f64),
) -> f64 {
    match context.contacts.contact(level) {
        None => 0.0,
        Some(contact) if contact.is_stuck() => finder.force_at(context, method, level, place),
        Some(contact) => {
            let level = &context.dynamics.system.levels()[level];
            contact.force(level, delta, rate).value
        }
    }
}
