(** * Closed forms of the built-in cases

    Claim.  The optical depth and the radiance that each case states are the
    integrals of its own field and transfer functions, for every D >= 0.

    Source.  Etiene, Kirby and Silva, "A Study Of Discretization Errors In Volume
    Rendering Integral Approximations": [SineSquared] is the case of section 3
    (Table 1), [Reciprocal] that of section 4 (Table 2).  [HomogeneousSlab] is the
    textbook medium (Max 1995).  [ReciprocalSquare] is [Reciprocal] with C = s,
    because C tau = 1 in the latter cancels errors of the pre-integrated colour.

    Assumptions.  Only D >= 0.  In [SineSquared] the extinction turns negative
    once D^2 > pi/2: there the formula still holds, but no medium does.

    One module a case, named as in the code: the definition, a lemma that depth
    and radiance are primitives of the right functions, and what Integral.v draws
    from that, as an integral and as an equation. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral.
Open Scope R_scope.

(** Continuity from differentiability, and a derivative by the usual rules; both
    leave the side conditions and, the second, the equation between derivatives. *)
Ltac continuity := unfold extinction_along, source;
  apply (ex_derive_continuous (V := R_NormedModule)); auto_derive.
Ltac derivative := unfold extinction_along, source; auto_derive.

(** s = l, tau = s cos s^2, C = sin s^2. *)
Module SineSquared.
  Definition field (l : R) : R := l.
  Definition extinction (s : R) : R := s * cos (s ^ 2).
  Definition emission (s : R) : R := sin (s ^ 2).
  Definition exact_depth (l : R) : R := sin (l ^ 2) / 2.
  Definition exact_radiance (l : R) : R := 2 - (sin (l ^ 2) + 2) * exp (- (sin (l ^ 2) / 2)).

  Lemma primitives (D : R) : manufactured field extinction emission exact_depth exact_radiance D.
  Proof.
    unfold field, extinction, emission, exact_depth, exact_radiance.
    split; [intros l _ .. | |].
    - now continuity.
    - now continuity.
    - derivative; [easy | simpl; field].
    - derivative; [easy | simpl; unfold Rdiv; field].
    - rewrite pow_i, sin_0 by auto. field.
    - rewrite pow_i, sin_0 by auto. replace (- (0 / 2)) with 0 by field.
      rewrite exp_0. ring.
  Qed.

  Theorem optical_depth_integral (D : R) :
    0 <= D -> is_RInt (extinction_along field extinction) 0 D (exact_depth D).
  Proof. intros HD. apply (manufactured_optical_depth (primitives D)). lra. Qed.

  Theorem optical_depth_eq (D : R) : 0 <= D -> optical_depth field extinction D = exact_depth D.
  Proof. intros HD. now apply is_RInt_unique, optical_depth_integral. Qed.

  Theorem radiance_integral (D : R) :
    0 <= D -> is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
  Proof. intros HD. apply (manufactured_radiance (primitives D)). lra. Qed.

  Theorem radiance_eq (D : R) :
    0 <= D -> radiance field extinction emission D = exact_radiance D.
  Proof. intros HD. now apply is_RInt_unique, radiance_integral. Qed.
End SineSquared.

(** s = 1 / (1 + l), tau = s, C = 1 / s; the source term is 1. *)
Module Reciprocal.
  Definition field (l : R) : R := 1 / (1 + l).
  Definition extinction (s : R) : R := s.
  Definition emission (s : R) : R := 1 / s.
  Definition exact_depth (l : R) : R := ln (1 + l).
  Definition exact_radiance (l : R) : R := ln (1 + l).

  Lemma primitives (D : R) : manufactured field extinction emission exact_depth exact_radiance D.
  Proof.
    unfold field, extinction, emission, exact_depth, exact_radiance.
    split; [intros l Hl .. | |].
    - continuity. lra.
    - continuity. assert (0 < / (1 + l)) by (apply Rinv_0_lt_compat; lra). lra.
    - derivative; [lra | field; lra].
    - derivative; [lra |]. rewrite exp_Ropp, exp_ln by lra. field. lra.
    - now rewrite Rplus_0_r, ln_1.
    - now rewrite Rplus_0_r, ln_1.
  Qed.

  Theorem optical_depth_integral (D : R) :
    0 <= D -> is_RInt (extinction_along field extinction) 0 D (exact_depth D).
  Proof. intros HD. apply (manufactured_optical_depth (primitives D)). lra. Qed.

  Theorem optical_depth_eq (D : R) : 0 <= D -> optical_depth field extinction D = exact_depth D.
  Proof. intros HD. now apply is_RInt_unique, optical_depth_integral. Qed.

  Theorem radiance_integral (D : R) :
    0 <= D -> is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
  Proof. intros HD. apply (manufactured_radiance (primitives D)). lra. Qed.

  Theorem radiance_eq (D : R) :
    0 <= D -> radiance field extinction emission D = exact_radiance D.
  Proof. intros HD. now apply is_RInt_unique, radiance_integral. Qed.
End Reciprocal.

(** tau = kappa and C = c whatever the field. *)
Module HomogeneousSlab.
Section Slab.
  Variable field : R -> R.
  Variables c kappa : R.
  Definition extinction (s : R) : R := kappa.
  Definition emission (s : R) : R := c.
  Definition exact_depth (l : R) : R := kappa * l.
  Definition exact_radiance (l : R) : R := c * (1 - exp (- (kappa * l))).

  Lemma primitives (D : R) : manufactured field extinction emission exact_depth exact_radiance D.
  Proof.
    unfold extinction, emission, exact_depth, exact_radiance.
    split; [intros l _ .. | |].
    - now continuity.
    - now continuity.
    - derivative; [easy | ring].
    - derivative; [easy | ring].
    - ring.
    - rewrite Rmult_0_r, Ropp_0, exp_0. ring.
  Qed.

  Theorem optical_depth_integral (D : R) :
    0 <= D -> is_RInt (extinction_along field extinction) 0 D (exact_depth D).
  Proof. intros HD. apply (manufactured_optical_depth (primitives D)). lra. Qed.

  Theorem optical_depth_eq (D : R) : 0 <= D -> optical_depth field extinction D = exact_depth D.
  Proof. intros HD. now apply is_RInt_unique, optical_depth_integral. Qed.

  Theorem radiance_integral (D : R) :
    0 <= D -> is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
  Proof. intros HD. apply (manufactured_radiance (primitives D)). lra. Qed.

  Theorem radiance_eq (D : R) :
    0 <= D -> radiance field extinction emission D = exact_radiance D.
  Proof. intros HD. now apply is_RInt_unique, radiance_integral. Qed.
End Slab.
End HomogeneousSlab.

(** s = 1 / (1 + l), tau = s, C = s; the source term is s^2. *)
Module ReciprocalSquare.
  Definition field (l : R) : R := 1 / (1 + l).
  Definition extinction (s : R) : R := s.
  Definition emission (s : R) : R := s.
  Definition exact_depth (l : R) : R := ln (1 + l).
  Definition exact_radiance (l : R) : R := (1 - / (1 + l) ^ 2) / 2.

  Lemma primitives (D : R) : manufactured field extinction emission exact_depth exact_radiance D.
  Proof.
    unfold field, extinction, emission, exact_depth, exact_radiance.
    split; [intros l Hl .. | |].
    - continuity. lra.
    - continuity. lra.
    - derivative; [lra | field; lra].
    - derivative; [simpl; nra |]. rewrite exp_Ropp, exp_ln by lra. field. lra.
    - now rewrite Rplus_0_r, ln_1.
    - field.
  Qed.

  Theorem optical_depth_integral (D : R) :
    0 <= D -> is_RInt (extinction_along field extinction) 0 D (exact_depth D).
  Proof. intros HD. apply (manufactured_optical_depth (primitives D)). lra. Qed.

  Theorem optical_depth_eq (D : R) : 0 <= D -> optical_depth field extinction D = exact_depth D.
  Proof. intros HD. now apply is_RInt_unique, optical_depth_integral. Qed.

  Theorem radiance_integral (D : R) :
    0 <= D -> is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
  Proof. intros HD. apply (manufactured_radiance (primitives D)). lra. Qed.

  Theorem radiance_eq (D : R) :
    0 <= D -> radiance field extinction emission D = exact_radiance D.
  Proof. intros HD. now apply is_RInt_unique, radiance_integral. Qed.
End ReciprocalSquare.
