(** * even-emission-thin: A source that is the same everywhere on a ray of a thousandth

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  300 + 400000 * s.
Definition emission (s : R) : R :=
  5.
Definition exact_depth (lambda : R) : R :=
  300 * lambda + 200000 * lambda ^ 2.
Definition exact_radiance (lambda : R) : R :=
  5 - 5 * exp (- (300 * lambda + 200000 * lambda ^ 2)).

Theorem even_emission_thin (D : R) :
  0 <= D <= 1 / 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
